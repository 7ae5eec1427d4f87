//! A step allocates nothing: a counting allocator for the whole test binary, read around steps.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    static COUNT: Cell<u64> = const { Cell::new(0) };
}

struct Counting;

#[expect(unsafe_code, reason = "an allocator cannot be written without; it only counts and passes on")]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let _ = COUNT.try_with(|c| c.set(c.get() + 1));
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Allocations of this thread while `work` runs.
fn allocations(work: impl FnOnce()) -> u64 {
    let before = COUNT.with(Cell::get);
    work();
    COUNT.with(Cell::get) - before
}

/// Between two searches of the neighbours (which may grow the lists) neither method allocates.
#[test]
fn steps_allocate_nothing() {
    for method in ["dem", "lattice"] {
        let (mut engine, mut hosts, mut ledger) = crate::dem::open("damper", &[&format!("method={method}")]);
        engine.advance(2000, &mut hosts, &mut ledger).unwrap();
        let steps: Vec<u64> =
            (0..200).map(|_| allocations(|| engine.advance(1, &mut hosts, &mut ledger).unwrap())).collect();
        let quiet = steps.iter().filter(|n| **n == 0).count();
        // A search may fall into the window; all other steps must be silent.
        assert!(quiet >= 195, "{method}: only {quiet} of 200 steps allocate nothing");
        // The control: the same counter sees an allocation where there is one.
        assert!(allocations(|| drop(std::hint::black_box(vec![1u8]))) > 0);
    }
}
