//! The words of each question as its type.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use lptn::*;

use crate::subject::{Asked, Found};
use crate::trouble::Trouble;
use crate::words::{Words, whole};

type Outcome = Result<Found, Trouble>;

pub(crate) fn check(asked: &Asked<'_>, words: &Words) -> Outcome {
    let question =
        CheckQuestion { case: words.text("case"), set: asked.set(words), command: Vec::new() };
    let missing = || Trouble::of_type("`check` needs one file".to_owned());
    let [file] = asked.files.as_slice() else { return Err(missing()) };
    Ok(Box::new(question.ask(file)?))
}

pub(crate) fn run(asked: &Asked<'_>, words: &Words) -> Outcome {
    let mut input = asked.input(words)?;
    let [stop, every] = ["stop", "every"].map(|name| words.text(name));
    if stop.is_some() || every.is_some() {
        Arc::make_mut(&mut input).set_times(stop.as_deref(), every.as_deref())?;
    }
    let question = RunQuestion {
        tolerance: words.text("tolerance"),
        select: words.texts("select"),
        temperature_unit: words.text("temperature_unit"),
        time_unit: words.one_of("time_unit", &TimeUnit::ALL, TimeUnit::symbol)?,
        balance: words.text("balance"),
        format: Format::Json,
        picture: true,
        uncertainty: uncertainty(words)?,
        certify: words.flag("certify"),
        ..RunQuestion::default()
    };
    Ok(Box::new(question.ask(input, asked.listener)?))
}

fn uncertainty(words: &Words) -> Result<Option<UncertaintyQuestion>, Trouble> {
    let key = |method| if method == Method::Linear { "linear" } else { "sobol" };
    let method = words.one_of("uncertainty", &[Method::Linear, Method::Sobol], key)?;
    let others = (words.count("samples")?, words.count("seed")?, words.count("threads")?);
    let (samples, seed, threads) = others;
    match method {
        Some(method) => Ok(Some(UncertaintyQuestion { method, samples, seed, threads })),
        None if samples.is_none() && seed.is_none() && threads.is_none() => Ok(None),
        None => Err(Trouble::of_type(
            "`samples`, `seed` and `threads` need `uncertainty`: write uncertainty=\"sobol\""
                .to_owned(),
        )),
    }
}

pub(crate) fn steady(asked: &Asked<'_>, words: &Words) -> Outcome {
    let (select, balance) = (words.texts("select"), words.text("balance"));
    let temperature_unit = words.text("temperature_unit");
    let [period, tolerance] = ["period", "tolerance"].map(|name| words.text(name));
    let (format, detail) = (Format::Json, Detail::Brief);
    let input = asked.input(words)?;
    let certify = words.flag("certify");
    if !words.flag("periodic") {
        if period.is_some() || tolerance.is_some() {
            return Err(Trouble::of_type(
                "`period` and `tolerance` need `periodic`: write periodic=True".to_owned(),
            ));
        }
        let question =
            SteadyQuestion { select, temperature_unit, balance, format, detail, certify };
        return Ok(Box::new(question.ask(input, asked.listener)?));
    }
    let report = false;
    let question = CycleQuestion {
        period,
        tolerance,
        select,
        temperature_unit,
        balance,
        format,
        report,
        detail,
        certify,
    };
    Ok(Box::new(question.ask(input, asked.listener)?))
}

pub(crate) fn modes(asked: &Asked<'_>, words: &Words) -> Outcome {
    let question = ModesQuestion { count: words.count("count")?, at: words.text("at") };
    Ok(Box::new(question.ask(asked.input(words)?, asked.listener)?))
}

pub(crate) fn verify(asked: &Asked<'_>, words: &Words) -> Outcome {
    let question = VerifyQuestion { tolerance: words.text("tolerance"), at: words.text("at") };
    let answer = question.ask(asked.input(words)?, asked.listener)?;
    let interrupted = || {
        let problem = Diagnostic::error("run::interrupted", "interrupted: nothing is verified");
        Failure::new(Exit::Interrupted, problem)
    };
    Ok(Box::new(answer.ok_or_else(interrupted)?))
}

pub(crate) fn compare(asked: &Asked<'_>, words: &Words) -> Outcome {
    let sort = words.one_of("sort", &SortKey::ALL, SortKey::key)?;
    let question = CompareQuestion {
        files: asked.files.clone(),
        set: asked.set(words),
        posterior: words.text("posterior").map(PathBuf::from),
        uncertainty: words.flag("uncertainty"),
        parts: words.texts("parts").into_iter().map(PathBuf::from).collect(),
        csv: CsvOptions::default(),
        cases: words.flag("cases"),
        periodic: words.flag("periodic"),
        sort: sort.unwrap_or(SortKey::Margin),
        temperature_unit: words.text("temperature_unit"),
        threads: words.count("threads")?,
        detail: Detail::Brief,
        command: Vec::new(),
    };
    if question.uncertainty && question.periodic {
        return Err(Trouble::of_type("`uncertainty` and `periodic` exclude each other".to_owned()));
    }
    Ok(Box::new(question.ask(asked.listener)?))
}

pub(crate) fn size(asked: &Asked<'_>, words: &Words) -> Outcome {
    let question = SizeQuestion {
        name: words.text("name"),
        threads: words.count("threads")?,
        writes: false,
        certify: words.flag("certify"),
    };
    Ok(Box::new(question.ask(asked.input(words)?, asked.listener)?))
}

pub(crate) fn cooling(_: &Asked<'_>, words: &Words) -> Outcome {
    let needed = |name: &str| {
        let missing = || Trouble::of_type(format!("`size` without a network needs `{name}`"));
        words.text(name).ok_or_else(missing)
    };
    let question = CoolingQuestion {
        power: needed("power")?,
        limit: needed("limit")?,
        ambient: needed("ambient")?,
        rise: words.text("rise"),
        command: Vec::new(),
    };
    Ok(Box::new(question.ask()?))
}

pub(crate) fn rank(asked: &Asked<'_>, words: &Words) -> Outcome {
    let key = |over| if matches!(over, Over::Steady) { "steady" } else { "run" };
    let over = words.one_of("over", &[Over::Steady, Over::Run], key)?;
    let question = RankQuestion {
        node: words.text("of"),
        over: over.unwrap_or(Over::Steady),
        temperature_unit: words.text("temperature_unit"),
    };
    Ok(Box::new(question.ask(asked.input(words)?, asked.listener)?))
}

pub(crate) fn sweep(asked: &Asked<'_>, words: &Words) -> Outcome {
    let shard = words.text("shard").map(|text| text.parse().map_err(Trouble::of_value));
    let question = SweepQuestion {
        name: words.text("name"),
        temperature_unit: words.text("temperature_unit"),
        shard: shard.transpose()?,
    };
    let sweep = question.of(asked.input(words)?)?;
    Ok(Box::new(sweep.in_memory(words.count("threads")?, asked.listener)?))
}

pub(crate) fn fit_network(asked: &Asked<'_>, words: &Words) -> Outcome {
    let question = FitNetworkQuestion { study: words.text("name"), starts: words.count("starts")? };
    // a fit begins with the netlist's own values: those of another fit may count the same records
    let input = asked.input_with(&Belief::None, words)?;
    Ok(Box::new(question.ask(input, asked.listener)?))
}

pub(crate) fn fit_compare(asked: &Asked<'_>, words: &Words) -> Outcome {
    let question = FitCompareQuestion {
        fits: words.texts("fit"),
        starts: words.count("starts")?,
        threads: words.count("threads")?,
    };
    let one = |path: &PathBuf| {
        let input = Input::open(path, &Belief::None, (None, &asked.set(words)))?;
        Ok(CandidateNetlist { path: path.clone(), label: String::new(), input: Arc::new(input) })
    };
    let netlists: Vec<_> = asked.files.iter().map(one).collect::<Result<_, Failure>>()?;
    Ok(Box::new(question.ask(&netlists, asked.listener)?))
}

/// The file that a question is about.
fn file(words: &Words, name: &str) -> Result<PathBuf, Trouble> {
    let missing = || Trouble::of_type(format!("`{name}` is missing: name a file"));
    words.text(name).map(PathBuf::from).ok_or_else(missing)
}

pub(crate) fn fit_step(asked: &Asked<'_>, words: &Words) -> Outcome {
    let record = file(words, "record")?;
    if let Some(count) = words.text("terms") {
        return fit_terms((&record, &count), asked, words);
    }
    let reference = words.text("reference").unwrap_or_else(|| "initial".to_owned());
    let question = FitStepQuestion {
        columns: words.texts("column"),
        time: words.text("time"),
        from: words.text("from"),
        to: words.text("to"),
        drop_outliers: words.flag("drop_outliers"),
        csv: CsvOptions::default(),
        capacity: words.text("capacity"),
        reference: Some(reference),
        sensor: words.text("sensor"),
        model: words.text("model").map(PathBuf::from),
        port: words.text("port"),
        posterior: false,
        temperature_unit: words.text("temperature_unit"),
        files: asked.memory.clone().into(),
        command: Vec::new(),
    };
    Ok(Box::new(question.ask(&record, asked.listener)?))
}

fn fit_terms((record, count): (&Path, &str), asked: &Asked<'_>, words: &Words) -> Outcome {
    let column = words.texts("column");
    let ignored = ["capacity", "sensor", "model", "reference"];
    if column.len() > 1 || ignored.iter().any(|name| words.text(name).is_some()) {
        return Err(Trouble::of_type(format!(
            "`terms` fits one column, without {}",
            ignored.join(", ")
        )));
    }
    let terms = if count == "auto" { None } else { Some(whole("terms", count)?) };
    let question = FitTermsQuestion {
        column: column.into_iter().next(),
        time: words.text("time"),
        from: words.text("from"),
        to: words.text("to"),
        drop_outliers: words.flag("drop_outliers"),
        csv: CsvOptions::default(),
        power: words.text("power"),
        terms,
        files: asked.memory.clone().into(),
        command: Vec::new(),
    };
    Ok(Box::new(question.ask(record, asked.listener)?))
}

pub(crate) fn fit_law(asked: &Asked<'_>, words: &Words) -> Outcome {
    if words.text("dT").is_some() {
        return stated_laws(words);
    }
    let points = file(words, "points")?;
    let question = FitLawQuestion {
        speed: words.text("speed"),
        power: words.text("power"),
        rise: words.text("rise"),
        time_constant: words.text("time_constant"),
        laws: words.texts("law"),
        starts: words.texts("start"),
        unweighted: words.flag("unweighted"),
        capacity: words.text("capacity"),
        posterior: false,
        columns: words.texts("column"),
        reference: Some(words.text("reference").unwrap_or_else(|| "initial".to_owned())),
        sensor: words.text("sensor"),
        csv: CsvOptions::default(),
        files: asked.memory.clone().into(),
        command: Vec::new(),
    };
    if points.is_dir() || question.files.has_folder(&points) {
        return Ok(Box::new(question.ask_records(&points, asked.listener)?));
    }
    Ok(Box::new(question.ask(&points, asked.listener)?))
}

fn stated_laws(words: &Words) -> Outcome {
    let needed = |name: &str| {
        let missing = || Trouble::of_type(format!("`dT` needs `{name}`"));
        words.text(name).ok_or_else(missing)
    };
    let question = StatedLawsQuestion {
        rise: needed("dT")?,
        time_constant: needed("t_RC")?,
        power: needed("P")?,
        over: needed("over")?,
        capacity: words.text("capacity"),
    };
    Ok(Box::new(question.ask()?))
}

pub(crate) fn infer(asked: &Asked<'_>, words: &Words) -> Outcome {
    let question = InferQuestion { study: words.text("name") };
    Ok(Box::new(question.ask(asked.input(words)?, asked.listener)?))
}

pub(crate) fn plan(asked: &Asked<'_>, words: &Words) -> Outcome {
    let question = PlanQuestion { study: words.text("name") };
    Ok(Box::new(question.ask(asked.input(words)?, asked.listener)?))
}

pub(crate) fn reduce(asked: &Asked<'_>, words: &Words) -> Outcome {
    let max_error = words.text("max_error").unwrap_or_else(|| "5%".to_owned());
    let [error, power] = ["error", "power"].map(|name| words.text(name));
    let nodes = words.count("nodes")?;
    let temperature_unit = words.text("temperature_unit");
    let input = asked.input(words)?;
    let keep = words.texts("keep");
    if !keep.is_empty() {
        let question = KeepQuestion { keep, nodes, max_error, error, power, temperature_unit };
        return Ok(Box::new(question.ask(input)?));
    }
    let question = ReduceQuestion {
        port: words.text("port"),
        max_error,
        error,
        power,
        nodes,
        judge: words.one_of("for", &Judge::ALL, Judge::key)?.unwrap_or_default(),
        definition: words.one_of("definition", &Definition::ALL, Definition::key)?,
        bias: words.flag("bias"),
        window: words.text("window"),
        at: words.text("at"),
        temperature_unit,
    };
    Ok(Box::new(question.ask(input, asked.listener)?))
}

pub(crate) fn impedance(asked: &Asked<'_>, words: &Words) -> Outcome {
    let question = ImpedanceQuestion {
        port: words.text("port"),
        to: words.text("to"),
        form: form(words)?,
        at: words.text("at"),
        writes: false,
    };
    Ok(Box::new(question.ask(asked.input(words)?, asked.listener)?))
}

fn form(words: &Words) -> Result<ImpedanceForm, Trouble> {
    let chain = |name: &str, ladder| {
        let count = words.flag_or_text(name)?;
        let count = count.map(|text| whole(name, &text)).transpose();
        Some(count.map(|count| ImpedanceForm::Chain { count, ladder }))
    };
    if let Some(chain) = chain("foster", false).or_else(|| chain("cauer", true)) {
        return chain;
    }
    Ok(match words.flag_or_text("omega") {
        Some(list) => ImpedanceForm::Swing(list),
        None => ImpedanceForm::Step { times: words.text("time"), shares: words.text("duty") },
    })
}

pub(crate) fn gear(asked: &Asked<'_>, words: &Words) -> Outcome {
    let question = GearQuestion {
        gearbox: words.text("name"),
        speeds: words.texts("speed"),
        torques: words.texts("torque"),
        temperatures: words.texts("temperature"),
        temperature_unit: words.text("temperature_unit"),
    };
    Ok(Box::new(question.ask(asked.input(words)?)?))
}
