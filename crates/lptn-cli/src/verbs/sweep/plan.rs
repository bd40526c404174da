//! `lptn sweep plan`: the job that a scheduler runs.

use lptn_netlist::SweepStudy;

use super::args::PlanArgs;
use crate::console::Console;
use crate::input::Load as _;
use crate::options::Source;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::{Input, quoted};
use lptn_answer::sweep as asked;

pub(crate) fn plan(args: &PlanArgs, console: &Console) -> Result<Exit, Failure> {
    let source = Source { file: args.file.clone(), set: args.set.clone(), case: args.case.clone() };
    let input = Input::load(&source)?;
    let study = asked::study(&input, args.name.as_deref())?;
    let cases = study.plan(&input.netlist.network).map(|plan| plan.cases).unwrap_or(0);
    let job = Job::of(args, &input, (study, cases));
    console.print(&if args.slurm { job.slurm() } else { job.hyperqueue() })
}

/// Values that both kinds of script use.
struct Job {
    name: String,
    cases: u64,
    shards: u64,
    cores: u64,
    /// The command of a part, without its number.
    sweep: String,
    merge: String,
    folder: String,
}

impl Job {
    fn of(args: &PlanArgs, input: &Input, (study, cases): (&SweepStudy, u64)) -> Self {
        let folder = args.output.clone().unwrap_or_else(|| asked::folder(input, study));
        let folder = quoted(&folder.display().to_string());
        let file = quoted(&args.file.display().to_string());
        let set = args.set.iter().map(|set| format!(" --set {}", quoted(set)));
        let case = args.case.iter().map(|case| format!(" --case {}", quoted(case)));
        let set: Vec<String> = case.chain(set).collect();
        let name = &study.name;
        // a part without a candidate would have nothing to do
        let shards = args.shards.min(cases.max(1));
        let sweep = format!(
            "lptn sweep {file} {name}{} -o {folder} --resume --threads {} --quiet",
            set.concat(),
            args.cores
        );
        let merge = format!("lptn sweep merge {folder}");
        Self { name: name.clone(), cases, shards, cores: args.cores, sweep, merge, folder }
    }

    /// A job array, to be sent with `sbatch`.
    /// Parts that failed or were killed continue when the same script is sent again.
    fn slurm(&self) -> String {
        let Self { name, cases, shards, cores, sweep, merge, folder } = self;
        format!(
            "#!/bin/sh\n\
             # {cases} candidates in {shards} parts. Send it: sbatch --parsable FILE\n\
             # and then: sbatch --dependency=afterok:JOB --wrap \"{merge}\"\n\
             # A part that failed goes on where it stopped when the job is sent again.\n\
             #SBATCH --job-name={name}\n\
             #SBATCH --array=1-{shards}\n\
             #SBATCH --cpus-per-task={cores}\n\
             #SBATCH --output=%x-%a.log\n\
             mkdir -p {folder}\n\
             {sweep} --shard auto\n"
        )
    }

    /// A task array that waits for its end and joins the parts.
    fn hyperqueue(&self) -> String {
        let Self { name, cases, shards, cores, sweep, merge, folder } = self;
        format!(
            "#!/bin/sh\n\
             # {cases} candidates in {shards} parts; a server and workers of HyperQueue are running.\n\
             # A part that failed goes on where it stopped when this is started again.\n\
             set -eu\n\
             mkdir -p {folder}\n\
             hq submit --wait --name {name} --array 1-{shards} --cpus {cores} -- \\\n\
             \x20   sh -c '{} --shard \"$HQ_TASK_ID/{shards}\"'\n\
             {merge}\n",
            sweep.replace('\'', "'\\''")
        )
    }
}
