//! The parser as clap builds it.

use clap::CommandFactory as _;

use crate::args::Args;

/// The help of the program.
pub(crate) fn help() -> String {
    Args::command().render_help().to_string()
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    #[test]
    fn the_parser_is_sound() {
        crate::args::Args::command().debug_assert();
    }
}
