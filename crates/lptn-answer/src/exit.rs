//! The exit codes, which scripts rely on.

use lptn_units::Class;

/// Exit code of a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Exit {
    /// Done.
    Done = 0,
    /// Done, and the answer is no; the last line says which.
    /// For `check`: the file could be read and has errors.
    No = 1,
    /// The input is wrong: usage, a missing file, unreadable TOML, a netlist with errors.
    /// For `check` errors of the netlist are [`Exit::No`]. clap uses this number for usage.
    Input = 2,
    /// The numbers or the writing of results failed. Computed results are kept and marked.
    Failed = 3,
    /// Ctrl-C: 128 plus the number of the signal, as shells count.
    /// Computed results are kept and marked.
    Interrupted = 130,
}

impl From<Class> for Exit {
    fn from(class: Class) -> Self {
        match class {
            Class::Input => Self::Input,
            Class::Numbers => Self::Failed,
            Class::No => Self::No,
            Class::Interrupted => Self::Interrupted,
        }
    }
}
