//! The server alone: who is refused, what is given.

use crate::support::{Served, run_folder};
use std::net::TcpListener;
use std::path::PathBuf;
use tsubu_frame::Advise;
use tsubu_view::Server;

/// Head and arrays of a frame's packet.
fn packet(bytes: &[u8]) -> (serde_json::Value, Vec<[u8; 4]>) {
    let length = u32::from_le_bytes(bytes[..4].try_into().expect("four")) as usize;
    let head = serde_json::from_slice(&bytes[4..4 + length]).expect("JSON");
    (head, bytes[4 + length..].as_chunks::<4>().0.to_vec())
}

#[test]
fn whoever_knows_the_address_is_given_the_page_and_the_frames() {
    let folder = run_folder(3);
    let served = Served::of(&[folder.path()]);
    let (status, page) = served.get("");
    assert_eq!(status, 200);
    assert!(String::from_utf8_lossy(&page).contains("<title>tsubu view</title>"));
    let runs: serde_json::Value = serde_json::from_slice(&served.get("runs").1).expect("JSON");
    assert_eq!(runs[0]["times"].as_array().map(Vec::len), Some(3));
    let (status, history) = served.get("run/0/history");
    assert_eq!((status, history.starts_with(b"time [s],kinetic")), (200, true));
    let (status, bytes) = served.get("run/0/frame/2?colour=velocity+z&contacts=1");
    assert_eq!(status, 200);
    let (head, words) = packet(&bytes);
    assert_eq!((head["grains"].as_u64(), head["step"].as_u64()), (Some(2), Some(20)));
    let mut offset = 0;
    for (name, length, first) in [
        ("position", 6, -1.0_f32),
        ("radius", 2, 0.5),
        ("group", 2, 0.0),
        ("id", 2, f32::from_bits(7)),
        ("lines", 24, -2.0),
        ("triangles", 0, 0.0),
        ("bonds", 12, -1.0),
        ("forces", 2, 5.0),
        ("colour", 2, 0.0),
    ] {
        let place = head["arrays"].as_array().and_then(|all| all.iter().find(|array| array["name"] == name));
        assert_eq!(place.and_then(|array| array["length"].as_u64()), Some(length), "{name}");
        if length > 0 {
            assert_eq!(f32::from_le_bytes(words[offset]), first, "{name}");
        }
        offset += length as usize;
    }
    assert_eq!(offset, words.len());
    let range: Vec<f64> = serde_json::from_slice(&served.get("run/0/range?colour=velocity+z").1).expect("JSON");
    assert_eq!(range, [0.0, 2.0]);
    let grain: serde_json::Value = serde_json::from_slice(&served.get("run/0/frame/1/grain/1").1).expect("JSON");
    assert_eq!(grain[0]["value"], 9);
}

#[test]
fn strangers_are_refused() {
    let folder = run_folder(1);
    let served = Served::of(&[folder.path()]);
    let Served { port, token, .. } = &served;
    let own = format!("Host: 127.0.0.1:{port}");
    let other = "0".repeat(32);
    for (told, request) in [
        ("no token", format!("GET / HTTP/1.1\r\n{own}")),
        ("no token", format!("GET /runs HTTP/1.1\r\n{own}")),
        ("a wrong token", format!("GET /{other}/runs HTTP/1.1\r\n{own}")),
        ("a part of the token", format!("GET /{}/runs HTTP/1.1\r\n{own}", &token[..31])),
        ("another host", format!("GET /{token}/runs HTTP/1.1\r\nHost: grains.example:{port}")),
        ("another port", format!("GET /{token}/runs HTTP/1.1\r\nHost: 127.0.0.1:1")),
        ("no host", format!("GET /{token}/runs HTTP/1.0")),
        ("another origin", format!("GET /{token}/runs HTTP/1.1\r\n{own}\r\nOrigin: http://grains.example")),
        ("no origin in particular", format!("GET /{token}/runs HTTP/1.1\r\n{own}\r\nOrigin: null")),
        ("who wants to write", format!("POST /{token}/runs HTTP/1.1\r\n{own}\r\nContent-Length: 0")),
    ] {
        let (status, body) = served.say(&format!("{request}\r\nConnection: close\r\n\r\n"));
        assert_eq!(status, 403, "{told}");
        assert!(!String::from_utf8_lossy(&body).contains("times"), "{told}");
    }
    let page = format!("{own}\r\nOrigin: http://127.0.0.1:{port}\r\nConnection: close");
    assert_eq!(served.say(&format!("GET /{token}/runs HTTP/1.1\r\n{page}\r\n\r\n")).0, 200);
}

#[test]
fn no_path_leads_out() {
    let folder = run_folder(1);
    std::fs::write(folder.path().join("secret.txt"), "secret").expect("written");
    let served = Served::of(&[folder.path()]);
    for path in [
        "page/../secret.txt",
        "page/%2e%2e/secret.txt",
        "page/..%2fsecret.txt",
        "../../etc/passwd",
        "page//etc/passwd",
        "secret.txt",
        "run/0/secret.txt",
        "run/0/../secret.txt",
        "run/1/about",
        "run/-1/about",
        "run/0/frame/1",
        "run/0/frame/..%2f..%2fsecret.txt",
        "run/0/frame/0/grain/2",
        "run/0/frame/99999999999999999999999999",
    ] {
        let (status, body) = served.get(path);
        assert_eq!((status, String::from_utf8_lossy(&body).contains("root:")), (404, false), "{path}");
    }
}

/// A folder that somebody else made may hold links: to the password file, say.
#[cfg(unix)]
#[test]
fn no_link_leads_out() {
    let (folder, elsewhere) = (run_folder(2), run_folder(2));
    let served = Served::of(&[folder.path()]);
    for name in ["frames/grains_000001.vtp", "frames/walls_000000.vtp", "history.csv"] {
        std::fs::remove_file(folder.path().join(name)).expect("it was there");
        std::os::unix::fs::symlink(elsewhere.path().join(name), folder.path().join(name)).expect("a link");
    }
    for path in ["run/0/frame/1", "run/0/frame/0", "run/0/history"] {
        let (status, body) = served.get(path);
        let body = String::from_utf8_lossy(&body);
        assert_eq!((status, body.contains("leads out of its run folder")), (500, true), "{path}: {body}");
    }
}

#[test]
fn a_damaged_frame_is_told() {
    let folder = run_folder(1);
    let served = Served::of(&[folder.path()]);
    let file = folder.path().join("frames/grains_000000.vtp");
    let bytes = std::fs::read(&file).expect("it is there");
    std::fs::write(&file, &bytes[..bytes.len() / 2]).expect("written");
    let (status, body) = served.get("run/0/frame/0");
    assert_eq!((status, String::from_utf8_lossy(&body).contains("is not as expected")), (500, true));
}

#[test]
fn what_cannot_be_shown_is_told_with_what_to_do() {
    let folder = run_folder(1);
    let empty = tempfile::tempdir().expect("a folder");
    let bare = tempfile::tempdir().expect("a folder");
    std::fs::write(bare.path().join("history.csv"), "time [s]\n").expect("written");
    let taken = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = taken.local_addr().expect("a port").port();
    for (path, port, said, hint) in [
        (PathBuf::from("no/such"), 0, "is not a folder", "tsubu run"),
        (empty.path().to_owned(), 0, "holds no run", "tsubu run"),
        (bare.path().to_owned(), 0, "without frames", "output.frame-interval"),
        (folder.path().to_owned(), port, "cannot listen on port", "--port"),
    ] {
        let error = Server::bind(&[path], port).err().expect("refused");
        assert!(error.to_string().contains(said), "{error}");
        assert!(error.told().contains(hint), "{}", error.told());
    }
}
