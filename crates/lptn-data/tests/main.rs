//! The tests of `lptn-data` in one program: each file is a module, and the rest is shared.

#![allow(
    unreachable_pub,
    dead_code,
    reason = "modules of tests, and tables that some of them share"
)]

mod record;
mod record_lines;
