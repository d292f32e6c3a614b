//! The two doors between C++ and Rust, which no panic passes.

use std::any::Any;
use std::fmt::Display;
use std::panic::{catch_unwind, AssertUnwindSafe};

/// The same type as `zenoh::Error`.
pub type Error = Box<dyn std::error::Error + Send + Sync + 'static>;

/// Runs what C++ asked for; a panic becomes an error like any other.
pub fn guarded<T>(work: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| Err(format!("panic: {}", panic_text(&*panic)).into()))
}

/// Runs a callback; what it threw, or a panic on the way to it, is told on stderr and ends there.
pub fn report<E: Display>(work: impl FnOnce() -> Result<(), E>) {
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(())) => {}
        Ok(Err(exception)) => eprintln!("urto: a transport callback threw: {exception}"),
        Err(panic) => eprintln!("urto: panic in a transport callback: {}", panic_text(&*panic)),
    }
}

fn panic_text(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| text.to_string());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "(no text)".to_string())
}
