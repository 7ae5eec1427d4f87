//! Damaged checkpoints are refused with a message, whatever the damage.

use std::path::Path;

use proptest::prelude::*;
use tsubu_frame::state::Section;
use tsubu_frame::{CheckpointError, Header, State, checkpoint};

fn sample() -> (Header, State<'static>) {
    let header = Header { tsubu_version: "0.1.0".into(), scene_hash: "c0ffee".into(), step: 12_345, time: 0.1 + 0.2 };
    let mut state = State::default();
    state.put_real("grain.position", vec![1.0, -0.0, f64::NAN, f64::MIN_POSITIVE / 2.0]);
    state.put_integer("grain.id", vec![0, -1, i64::MAX]);
    state.put_text("engine", "dem");
    state.put_real("empty", vec![]);
    (header, state)
}

fn bytes_of_sample() -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let (header, state) = sample();
    checkpoint::write(folder.path(), &state, &header).unwrap();
    std::fs::read(checkpoint::path(folder.path())).unwrap()
}

fn read_bytes(bytes: &[u8]) -> Result<(Header, State<'static>), CheckpointError> {
    let file = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(file.path(), bytes).unwrap();
    checkpoint::read(file.path())
}

#[test]
fn comes_back_bit_by_bit() {
    let folder = tempfile::tempdir().unwrap();
    let (header, state) = sample();
    for _ in 0..2 {
        checkpoint::write(folder.path(), &state, &header).unwrap();
    }
    let (header_back, state_back) = checkpoint::read(&checkpoint::path(folder.path())).unwrap();
    assert_eq!(header_back, header);
    assert_eq!(state_back.hash(), state.hash());
    let left: Vec<_> =
        std::fs::read_dir(folder.path().join("checkpoint")).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!(left, ["state.tsubu"], "no temporary file stays");
}

/// Numbers of things are in a file as integers are, and come back as either.
#[test]
fn numbers_of_things_are_integers() {
    let folder = tempfile::tempdir().unwrap();
    let mut state = State::default();
    state.put_index("id", vec![3, u32::MAX]);
    state.put_integer("wrong", vec![0, -1]);
    assert_eq!(state.clone().take_index("id").unwrap(), [3, u32::MAX]);
    checkpoint::write(folder.path(), &state, &sample().0).unwrap();
    let (_, mut back) = checkpoint::read(&checkpoint::path(folder.path())).unwrap();
    assert_eq!(back.integer("id").unwrap(), [3, i64::from(u32::MAX)]);
    assert_eq!(back.take_index("id").unwrap(), [3, u32::MAX]);
    assert!(["id", "wrong", "none"].iter().all(|name| back.take_index(name).is_err()));
}

#[test]
fn every_truncation_is_seen() {
    let bytes = bytes_of_sample();
    for length in 0..bytes.len() {
        let error = read_bytes(&bytes[..length]).unwrap_err();
        assert!(
            length == 0 || matches!(error, CheckpointError::Truncated { .. }),
            "cut at {length} of {}: {error}",
            bytes.len()
        );
    }
}

#[test]
fn every_flipped_byte_is_seen() {
    let bytes = bytes_of_sample();
    for at in 0..bytes.len() {
        let mut altered = bytes.clone();
        altered[at] ^= 0x10;
        let error = read_bytes(&altered).unwrap_err();
        assert!(!matches!(error, CheckpointError::Unreadable { .. }), "byte {at}: {error}");
    }
}

#[test]
fn appended_bytes_are_seen() {
    let mut bytes = bytes_of_sample();
    bytes.push(0);
    assert!(read_bytes(&bytes).is_err());
}

#[test]
fn messages_name_the_file_and_the_way_out() {
    let path = Path::new("out/checkpoint/state.tsubu");
    let error = checkpoint::read(path).unwrap_err().to_string();
    assert!(error.contains("state.tsubu") && error.contains("without --resume"), "{error}");
    let mut newer = bytes_of_sample();
    newer[8] = 9;
    let error = read_bytes(&newer).unwrap_err().to_string();
    assert!(error.contains("format 9") && error.contains("the tsubu that wrote it"), "{error}");
    let error = read_bytes(b"PK\x03\x04 something else").unwrap_err().to_string();
    assert!(error.contains("is not a tsubu checkpoint"), "{error}");
}

/// A section that claims 2^60 numbers must not be believed before they are there.
#[test]
fn a_claimed_length_is_not_believed() {
    let bytes = bytes_of_sample();
    let name = b"grain.position";
    let at = bytes.windows(name.len()).position(|w| w == name).unwrap() + name.len() + 1;
    let mut altered = bytes;
    altered[at..at + 8].copy_from_slice(&(1u64 << 60).to_le_bytes());
    assert!(read_bytes(&altered).is_err());
}

fn section() -> impl Strategy<Value = Section<'static>> {
    prop_oneof![
        prop::collection::vec(any::<f64>(), 0..50).prop_map(|reals| Section::Real(reals.into())),
        prop::collection::vec(any::<i64>(), 0..50).prop_map(Section::Integer),
        prop::collection::vec(any::<u32>(), 0..50).prop_map(|numbers| Section::Index(numbers.into())),
        ".{0,40}".prop_map(Section::Text),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_state_comes_back(sections in prop::collection::btree_map(".{0,12}", section(), 0..6)) {
        let mut state = State::default();
        for (name, section) in sections {
            state.insert(name, section);
        }
        let folder = tempfile::tempdir().unwrap();
        checkpoint::write(folder.path(), &state, &sample().0).unwrap();
        let (_, back) = checkpoint::read(&checkpoint::path(folder.path())).unwrap();
        prop_assert_eq!(back.hash(), state.hash());
    }

    #[test]
    fn garbage_is_refused(bytes in prop::collection::vec(any::<u8>(), 0..300), keep in 0usize..80) {
        prop_assert!(read_bytes(&bytes).is_err());
        let mut half_right = bytes_of_sample();
        half_right.truncate(keep);
        half_right.extend_from_slice(&bytes);
        prop_assert!(read_bytes(&half_right).is_err());
    }
}
