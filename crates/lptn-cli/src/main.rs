//! The program `lptn`: all of it is in the library, so that the Python package has it too.

fn main() -> std::process::ExitCode {
    std::process::ExitCode::from(lptn_cli::run(std::env::args_os().collect()))
}
