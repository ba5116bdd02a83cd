//! Failures of naga itself.

use std::panic::{AssertUnwindSafe, catch_unwind};

/// Runs a step of naga. If naga panics (a bug in it that a shader can trigger), gives the message.
pub fn guarded<T>(step: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(step)).map_err(|payload| {
        let text = payload.downcast_ref::<&str>().map(|text| (*text).to_owned());
        text.or_else(|| payload.downcast_ref::<String>().cloned()).unwrap_or_else(|| "without a message".to_owned())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_a_message() {
        assert_eq!(guarded(|| 1), Ok(1));
        assert_eq!(
            guarded(|| -> u32 { panic!("entered {}", "unreachable code") }),
            Err("entered unreachable code".into())
        );
        assert_eq!(guarded(|| -> u32 { panic!("plain") }), Err("plain".into()));
    }
}
