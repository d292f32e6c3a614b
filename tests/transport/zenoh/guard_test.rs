//! Tests of server/transport/zenoh/src/guard.rs: what panics or fails stays on its side.

#[path = "../../../server/transport/zenoh/src/guard.rs"]
mod guard;

use guard::{guarded, report, Error};

#[test]
fn results_pass() {
    assert_eq!(guarded(|| Ok(7)).unwrap(), 7);
    let refused: Result<(), Error> = guarded(|| Err("busy".into()));
    assert_eq!(refused.unwrap_err().to_string(), "busy");
}

#[test]
fn a_panic_becomes_an_error_with_its_text() {
    let plain: Result<(), Error> = guarded(|| panic!("plain"));
    assert_eq!(plain.unwrap_err().to_string(), "panic: plain");
    let formatted: Result<(), Error> = guarded(|| panic!("with {}", 2));
    assert_eq!(formatted.unwrap_err().to_string(), "panic: with 2");
    let other: Result<(), Error> = guarded(|| std::panic::panic_any(3));
    assert_eq!(other.unwrap_err().to_string(), "panic: (no text)");
}

#[test]
fn a_callback_neither_fails_nor_panics_its_caller() {
    let mut calls = 0;
    report::<String>(|| {
        calls += 1;
        Ok(())
    });
    report(|| {
        calls += 1;
        Err("thrown on purpose")
    });
    report::<String>(|| {
        calls += 1;
        panic!("on purpose")
    });
    assert_eq!(calls, 3);
}
