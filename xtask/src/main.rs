//! Chores of the project, run as `cargo xtask CHORE`.

#[cfg(test)]
mod architecture;
mod bench;
mod blocks;
mod book;
mod check;
mod claims;
mod cluster;
#[cfg(test)]
mod file_lengths;
mod fmu;
mod format;
mod generate;
mod guard;
#[cfg(test)]
mod imports;
mod mpi;
mod mutants;
mod optional;
mod python;
mod race;
mod shell;
mod spelling;
mod test;

use std::process::ExitCode;

const HELP: &str = "\
cargo xtask CHORE

  check [--no-test]   what must pass before a change goes in: format, spelling, lints, documentation, generated pages, all
                      tests, every scene in ten ways for a moment
  fmt [--check]       lay all code out, or only say what is not: cargo fmt, and the watches, which it does not come to
  test                the tests; with Python 3, also those that read written frames back with VTK
  patient             the tests that take from five seconds to a minute each: every scene checked, run and reported, large beds,
                      the slower of the quick verification cases; and some of the guards
  gen [--check]       write the generated pages and tables, or only say which are out of date
  spelling            look for misspelt words in all texts, where there is a Python 3
  book                build the book, where there is an mdbook
  optional            what needs more than Rust and a C compiler: the book, the pages in a browser, units for co-simulation,
                      MPI, Slurm and Dask, the Python package
  python [ARGUMENT]...
                      build the wheel, install it into a bare environment, and run its tests, where there is a Python 3.10 or later
                      and a network; arguments go to pytest
  fmu [ARGUMENT]...   pack units for co-simulation, and let FMPy validate and move them, where there is a Python 3.10 or later and a
                      network; arguments go to pytest
  mpi [ARGUMENT]...   build the program with MPI, and run it on several ranks under mpirun, where there is an MPI library; arguments go to
                      the tests
  cluster [ARGUMENT]...
                      start Slurm and Dask on this machine, run studies over them, and kill their workers; arguments go to pytest
  claims [NAME]...    run verification cases (without names all of up to a minute) and keep what they claim
  claims --from DIR   keep what `tsubu verify --controls -o DIR` has found, and run nothing
  mutants [WORDS]...  change a constant of the engines by 5 %, or leave a rule out, one after the other, and keep which verification
                      cases of up to four seconds notice (or cases that are named, of any length, or mutations in their
                      words); fails where none does
  chaotic             run the verification cases of up to ten seconds from two starts that differ in the last bit, and keep which
                      claims that moves
  fuzz [--seed N] [--seconds S] [--cases N] [--only KIND] [--case N]
                      draw scenes, files and command lines, and hold tsubu against them; --help says more
  variants [--quick] [--seed N]
                      one answer for every way to compute it: every scene by every method in ten ways that must not
                      matter (threads, outputs, a busy machine, cut and resumed); a quarter of an hour, --quick a minute
  same PROGRAM [--seconds S]
                      every scene by this program and by an earlier build of it: does a change that must not change a
                      number change one
  kills [--seed N] [--kills N]
                      kill runs of all kinds at random moments, resume them, and compare with runs left alone
  bench [ARGUMENT]... the benchmarks; arguments go to cargo bench
  race --peers DIR --lammps LMP [--runs 5] [--out NAME]
                      the race against LAMMPS; fails where a promise is not kept (Linux, about a quarter of an hour)
";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match words.as_slice() {
        ["check"] => check::check(true),
        ["check", "--no-test"] => check::check(false),
        ["fmt"] => format::write(),
        ["fmt", "--check"] => format::check(),
        ["test"] => test::test(),
        ["gen"] => generate::write(),
        ["gen", "--check"] => generate::check(),
        ["claims", names @ ..] => claims::claims(names),
        ["spelling"] => spelling::check(),
        ["book"] => book::book(),
        ["patient"] => check::patient(),
        ["optional"] => optional::optional(),
        ["python", rest @ ..] => python::python(rest),
        ["fmu", rest @ ..] => fmu::fmu(rest),
        ["mpi", rest @ ..] => mpi::mpi(rest),
        ["cluster", rest @ ..] => cluster::cluster(rest),
        ["mutants", names @ ..] => mutants::mutants(names),
        ["chaotic"] => mutants::chaotic(),
        ["fuzz", rest @ ..] => guard::guard("fuzz", rest),
        ["variants", rest @ ..] if rest.contains(&"--quick") => guard::guard("variants", rest),
        ["variants", rest @ ..] => guard::of_released("variants", rest),
        ["same", rest @ ..] => guard::of_released("same", rest),
        ["kills", rest @ ..] => guard::guard("kills", rest),
        ["bench", rest @ ..] => bench::bench(rest),
        ["race", rest @ ..] => race::race(rest),
        [] | ["help" | "--help" | "-h"] => {
            print!("{HELP}");
            Ok(())
        }
        other => Err(format!("there is no chore `{}`\n\n{HELP}", other.join(" "))),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}
