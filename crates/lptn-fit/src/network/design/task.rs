//! Tasks from a `[plan.NAME]` of a netlist.

use lptn_analysis::RunAnalysis;
use lptn_netlist::{
    FitRecord, FitStudy, Netlist, PlaceNumbers, PlanNumbers, PlanPlace, PlanStudy, RunNumbers,
    Sensor,
};
use lptn_network::{ParameterId, Varied};

use crate::network::design::error::DesignError;
use crate::network::design::given::{Given, GivenFit, given};
use crate::network::plan::{settings, weights};
use crate::network::task::{
    FitObserver, Instrument, Measurand, MeasuredColumn, MeasuredRun, NetworkFitTask,
};
use crate::network::unknown::Unknown;

/// A measurement to plan.
#[derive(Clone, Debug)]
pub struct DesignTask {
    /// The existing records, then a possible one for each run, with every place.
    pub(super) fit: NetworkFitTask,
    /// For each column of the existing records the variance of the mean of its residuals, over that
    /// of independent ones of its weight.
    pub(super) factors: Vec<Vec<f64>>,
    /// The fits of the existing records.
    pub given_fits: Vec<GivenFit>,
    /// The unknowns: parameters, then values of sensors that all records share.
    pub unknowns: Vec<Unknown>,
    /// The values of the unknowns for which the plan is made.
    pub values: Vec<f64>,
    /// The targets.
    pub known: Vec<Known>,
    /// Possible places of sensors.
    pub places: Vec<DesignPlace>,
    /// The runs that could be measured.
    pub runs: Vec<DesignRun>,
    /// The time between two samples in s.
    pub every: f64,
    /// Cost of an hour.
    pub hour: f64,
    /// Largest cost of everything; infinite without a limit.
    pub budget: f64,
}

/// An unknown with a target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Known {
    /// Its index among the unknowns.
    pub unknown: usize,
    /// Its required standard error, in its SI unit.
    pub error: f64,
}

/// A place where a sensor could be.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignPlace {
    /// Its name.
    pub name: String,
    /// Standard deviation of one sample in K: noise, drift and rounding together.
    pub deviation: f64,
    /// The part of that variance that drifts.
    pub correlated: f64,
    /// The share of it that is left from one sample to the next.
    pub decay: f64,
    /// Cost of a sensor there.
    pub cost: f64,
}

/// A run that could be measured.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignRun {
    /// Its name.
    pub name: String,
    /// Its cost in addition to that of its time.
    pub cost: f64,
    /// True if it is measured in any case.
    pub done: bool,
    /// Largest number of samples.
    pub samples: usize,
}

impl DesignTask {
    /// The task of a study. Its existing records are fitted first, and the plan is made for the
    /// fitted values.
    ///
    /// # Errors
    /// [`DesignError`] for a place that is not measured as a temperature of a node or a mean of
    /// some, for a fit that fails, and for numbers of the study that cannot be evaluated.
    pub fn of(
        netlist: &Netlist,
        study: &PlanStudy,
        (threads, observer): (usize, &FitObserver<'_>),
    ) -> Result<Self, DesignError> {
        let network = &netlist.network;
        let numbers = study.numbers(network, &netlist.overrides())?;
        let given = given(netlist, study, (threads, observer))?;
        let (sensors, instruments) = instruments(&netlist.studies.sensors, &study.places);
        let (places, columns) = places(netlist, study, (&numbers, &instruments))?;
        let settings = settings(netlist);
        let candidates = numbers.runs.iter();
        let candidates = candidates.map(|run| planned(run, &settings, (&columns, numbers.every)));
        let runs: Vec<MeasuredRun> = given.runs.iter().cloned().chain(candidates).collect();
        let parameters = estimated(netlist, (&numbers, &given));
        settable(netlist, study, &parameters)?;
        let ids: Vec<ParameterId> = parameters.iter().map(|varied| varied.parameter).collect();
        let correlations = netlist.overrides().correlations_of(&ids);
        let (more_starts, found) = (0, given.values);
        let mut fit = NetworkFitTask {
            network: network.clone(),
            parameters,
            correlations,
            sensors,
            runs,
            more_starts,
            threads,
        };
        for run in &mut fit.runs {
            found.iter().for_each(|(id, value)| run.parameters.set(*id, *value));
        }
        let unknowns: Vec<Unknown> =
            fit.unknowns().into_iter().filter(|unknown| unknown.run().is_none()).collect();
        let value = |unknown: &Unknown| {
            let fitted = found.iter().find(|(id, _)| unknown.parameter() == Some(*id));
            fitted.map_or(unknown.own, |(_, value)| *value)
        };
        let values: Vec<f64> = unknowns.iter().map(value).collect();
        let known = numbers.known.iter().enumerate();
        let known = known.map(|(i, (_, to))| Known { unknown: i, error: to.of(values[i]) });
        Ok(Self {
            known: known.collect(),
            runs: numbers.runs.iter().map(|run| DesignRun::new(run, numbers.every)).collect(),
            places,
            factors: given.factors,
            given_fits: given.fits,
            unknowns,
            values,
            fit,
            every: numbers.every,
            hour: numbers.hour,
            budget: numbers.budget,
        })
    }

    /// Number of existing records.
    pub fn given(&self) -> usize {
        self.factors.len()
    }

    /// True for a parameter, and for a value of a sensor at one of these places.
    pub fn concerns(&self, unknown: &Unknown, places: &[usize]) -> bool {
        let columns = self.fit.runs.last().map_or(&[][..], |run| run.columns.as_slice());
        let sensor_of = |place: &usize| columns.get(*place).and_then(|column| column.sensor);
        let sensor = unknown.sensor();
        sensor.is_none() || places.iter().any(|place| sensor_of(place) == sensor)
    }

    /// The names of all records, the existing ones first.
    pub fn record_names(&self) -> Vec<String> {
        self.fit.runs.iter().map(|run| run.name.clone()).collect()
    }

    /// Duration in s of a run with this number of samples.
    pub fn lasts(&self, samples: usize) -> f64 {
        samples.saturating_sub(1) as f64 * self.every
    }
}

/// Parameters to be estimated: those with a target, the other unknowns, and those that existing
/// records were fitted with. The records inform about all of these together, and about none alone.
fn estimated(netlist: &Netlist, (numbers, given): (&PlanNumbers, &Given)) -> Vec<Varied> {
    let mut ids: Vec<ParameterId> = numbers.known.iter().map(|(id, _)| *id).collect();
    for id in numbers.varied.iter().chain(given.values.iter().map(|(id, _)| id)) {
        if !ids.contains(id) {
            ids.push(*id);
        }
    }
    let set = netlist.overrides();
    let varied = |&parameter: &ParameterId| {
        let own = netlist.network.parameters()[parameter.index()].deviation;
        let value = netlist.network.parameter_value(parameter);
        let sigma = set.deviation(parameter).or(own).map(|spread| spread.sigma(value));
        let prior = sigma.filter(|sigma| *sigma > 0.0);
        Varied { parameter, bounds: (f64::NEG_INFINITY, f64::INFINITY), prior }
    };
    ids.iter().map(varied).collect()
}

/// Checks that no run and no existing record sets a parameter to be estimated.
fn settable(netlist: &Netlist, study: &PlanStudy, estimated: &[Varied]) -> Result<(), DesignError> {
    let given = |fit: &&FitStudy| study.given.contains(&fit.name);
    let fits = netlist.studies.fits.iter().filter(given);
    let records: Vec<(&FitStudy, &FitRecord)> =
        fits.flat_map(|fit| fit.records.iter().map(move |record| (fit, record))).collect();
    for varied in estimated {
        let name = &netlist.network.parameters()[varied.parameter.index()].name;
        let run = study.runs.iter().find(|run| run.sets(name));
        let run = run.map(|run| format!("run `{}`", run.name));
        let record = records.iter().find(|(_, record)| record.sets(name));
        let record =
            record.map(|(fit, record)| format!("the record {} of fit `{}`", record.csv, fit.name));
        if let Some(by) = run.or(record) {
            return Err(DesignError::Set { parameter: name.clone(), by });
        }
    }
    Ok(())
}

/// The places, and the column that each would have in a record.
fn places(
    netlist: &Netlist,
    study: &PlanStudy,
    (numbers, instruments): (&PlanNumbers, &[Option<usize>]),
) -> Result<(Vec<DesignPlace>, Vec<MeasuredColumn>), DesignError> {
    let sensors = &netlist.studies.sensors;
    let (mut places, mut columns) = (Vec::new(), Vec::new());
    for ((place, own), sensor) in study.places.iter().zip(&numbers.places).zip(instruments) {
        let planned = DesignPlace::new(place, (own, numbers.every), sensors);
        columns.push(MeasuredColumn {
            name: planned.name.clone(),
            of: Measurand::Temperatures(weights(&netlist.network, &place.observed)?),
            ty: place.observed.ty,
            sensor: *sensor,
            sigma: Some(planned.weight()),
            values: Vec::new(),
        });
        places.push(planned);
    }
    Ok((places, columns))
}

impl DesignRun {
    fn new(run: &RunNumbers, every: f64) -> Self {
        Self {
            name: run.name.clone(),
            cost: run.cost,
            done: run.done,
            samples: samples(run, every),
        }
    }
}

impl DesignPlace {
    fn new(place: &PlanPlace, (own, every): (&PlaceNumbers, f64), sensors: &[Sensor]) -> Self {
        let sensor = place.observed.sensor.as_ref();
        let sensor = sensors.iter().find(|known| Some(&known.name) == sensor);
        // rounding to steps of q adds a variance of q^2 / 12
        let step = sensor.and_then(|sensor| sensor.resolution).unwrap_or(0.0);
        let variance = own.noise.powi(2) + own.drift.powi(2) + step * step / 12.0;
        let drifts = own.drift > 0.0;
        let decay = if drifts { (-every / own.drift_time).exp() } else { 0.0 };
        Self {
            name: place.observed.column.clone(),
            deviation: variance.sqrt(),
            correlated: own.drift.powi(2) / variance,
            decay,
            cost: own.cost,
        }
    }

    /// The standard deviation in K by which a value is weighted. It includes that the mean of many
    /// values retains more of a drift than of independent noise. This is the `sigma` that a fit
    /// takes; without it the fit would trust a drifting record more than priors.
    pub fn weight(&self) -> f64 {
        let kept = (1.0 + self.decay) / (1.0 - self.decay);
        self.deviation * (1.0 + self.correlated * (kept - 1.0)).sqrt()
    }
}

/// The instruments, and that of each place. If a single place names an instrument, it is that one;
/// if several name it, each has its own.
fn instruments(sensors: &[Sensor], places: &[PlanPlace]) -> (Vec<Instrument>, Vec<Option<usize>>) {
    let mut all: Vec<Instrument> = sensors.iter().map(Instrument::from).collect();
    let named = |name: &String| {
        places.iter().filter(|place| place.observed.sensor.as_ref() == Some(name)).count()
    };
    let mut of_places = Vec::new();
    for place in places {
        let sensor = place.observed.sensor.as_ref();
        let own = sensors.iter().position(|known| Some(&known.name) == sensor);
        of_places.push(match (own, sensor) {
            (Some(own), Some(name)) if named(name) > 1 => {
                let name = place.observed.column.clone();
                all.push(Instrument { name, ..all[own].clone() });
                Some(all.len() - 1)
            }
            (own, _) => own,
        });
    }
    (all, of_places)
}

fn samples(run: &RunNumbers, every: f64) -> usize {
    // the last one counts if rounding leaves it just after the end
    let steps = (run.duration / every * (1.0 + 1e-12)).floor();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 1e6")]
    let steps = steps as usize;
    steps + 1
}

/// A possible record; its readings do not matter.
fn planned(
    run: &RunNumbers,
    settings: &RunAnalysis,
    (columns, every): (&[MeasuredColumn], f64),
) -> MeasuredRun {
    let count = samples(run, every);
    let columns = columns.iter().map(|c| MeasuredColumn { values: vec![0.0; count], ..c.clone() });
    MeasuredRun {
        name: run.name.clone(),
        parameters: run.parameters.clone(),
        signals: Vec::new(),
        initial: Vec::new(),
        settings: settings.clone(),
        times: (0..count).map(|k| settings.start() + k as f64 * every).collect(),
        columns: columns.collect(),
    }
}
