//! Reference: least squares against certified values, SciPy and closed forms.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_fit::Spectrum;
use lptn_fit::least_squares::{
    Evaluated, LeastSquaresError, LeastSquaresFit, Prior, Residuals, Settings, Side, Stop,
    Termination, minimise,
};
use lptn_units::{Dual, Scalar};

/// At most seven parameters, with derivatives.
type Number = Dual<7>;

/// A curve through points.
struct Curve<'a> {
    model: fn(f64, &[Number]) -> Number,
    points: &'a [(f64, f64)],
    parameters: usize,
}

impl Residuals for Curve<'_> {
    fn parameters(&self) -> usize {
        self.parameters
    }

    fn evaluate(&mut self, p: &[f64], _: bool) -> Evaluated {
        let b: Vec<Number> = p.iter().enumerate().map(|(j, &v)| Dual::variable(v, j)).collect();
        let values: Vec<Number> = self.points.iter().map(|(x, _)| (self.model)(*x, &b)).collect();
        let residuals = values.iter().zip(self.points).map(|(v, (_, y))| v.value - y).collect();
        let column = |j: usize| values.iter().map(move |v| v.derivatives[j]);
        Ok((residuals, (0..p.len()).flat_map(column).collect()))
    }
}

fn number(value: f64) -> Number {
    Dual::constant(value)
}

fn saturating(x: f64, b: &[Number]) -> Number {
    b[0] * (number(1.0) - (-b[1] * number(x)).exp())
}

fn cubics(x: f64, b: &[Number]) -> Number {
    let [x1, x2, x3] = [number(x), number(x * x), number(x * x * x)];
    (b[0] + b[1] * x1 + b[2] * x2 + b[3] * x3) / (number(1.0) + b[4] * x1 + b[5] * x2 + b[6] * x3)
}

fn kowalik(x: f64, b: &[Number]) -> Number {
    let x1 = number(x);
    b[0] * (x1 * x1 + x1 * b[1]) / (x1 * x1 + x1 * b[2] + b[3])
}

fn three_decays(x: f64, b: &[Number]) -> Number {
    let decay = |k: usize| b[k] * (-b[k + 1] * number(x)).exp();
    decay(0) + decay(2) + decay(4)
}

fn osborne(x: f64, b: &[Number]) -> Number {
    b[0] + b[1] * (-b[3] * number(x)).exp() + b[2] * (-b[4] * number(x)).exp()
}

fn meyer(x: f64, b: &[Number]) -> Number {
    b[0] * (b[1] / (number(x) + b[2])).exp()
}

/// A data set of the NIST Statistical Reference Datasets (nonlinear regression), in the file as
/// published at
/// <https://www.itl.nist.gov/div898/strd/nls/nls_main.shtml>.
struct Certified {
    starts: [Vec<f64>; 2],
    values: Vec<f64>,
    deviations: Vec<f64>,
    squares: f64,
    points: Vec<(f64, f64)>,
}

impl Certified {
    fn read(text: &str) -> Self {
        let numbers = |line: &str| {
            line.split_whitespace().filter_map(|w| w.parse().ok()).collect::<Vec<f64>>()
        };
        let named = |line: &&str| line.trim_start().starts_with('b') && line.contains(" = ");
        let rows: Vec<Vec<f64>> = text.lines().filter(named).map(numbers).collect();
        let column = |k: usize| rows.iter().map(|row| row[k]).collect::<Vec<f64>>();
        let sum = text.lines().find(|line| line.starts_with("Residual Sum of Squares")).unwrap();
        let data = text.lines().skip(60).map(numbers).filter(|row| row.len() == 2);
        Self {
            starts: [column(0), column(1)],
            values: column(2),
            deviations: column(3),
            squares: numbers(sum)[0],
            points: data.map(|row| (row[1], row[0])).collect(),
        }
    }
}

fn agrees(what: &str, found: &[f64], expected: &[f64], tolerance: f64) {
    for (j, (f, e)) in found.iter().zip(expected).enumerate() {
        assert!((f / e - 1.0).abs() < tolerance, "{what}, parameter {j}: {f} is not {e}");
    }
}

fn errors(found: &LeastSquaresFit) -> Vec<f64> {
    let variance = found.squares / f64::from(u32::try_from(found.degrees_of_freedom()).unwrap());
    let covariance = found.covariance().unwrap().scaled(variance);
    (0..found.parameters.len()).map(|j| covariance.standard_error(j).unwrap()).collect()
}

macro_rules! certified {
    ($name:ident, $file:literal, $model:expr, $tolerance:expr) => {
        #[test]
        fn $name() {
            let set = Certified::read(include_str!(concat!("nist/", $file, ".dat")));
            for (k, start) in set.starts.iter().enumerate() {
                let mut curve =
                    Curve { model: $model, points: &set.points, parameters: set.values.len() };
                let found = minimise(&mut curve, start, &Settings::default()).unwrap();
                let what = format!("{} from start {} after {}", $file, k + 1, found.evaluations);
                assert!(
                    found.outcome.converged(),
                    "{what}: {:?}, offset {:e}, p {:?}",
                    found.outcome,
                    found.offset,
                    found.parameters
                );
                agrees(&what, &found.parameters, &set.values, $tolerance);
                agrees(&what, &[found.squares], &[set.squares], 1e-9);
                agrees(&format!("deviation of {what}"), &errors(&found), &set.deviations, 1e-6);
            }
        }
    };
}

certified!(misra1a, "Misra1a", saturating, 1e-9);
certified!(hahn1, "Hahn1", cubics, 1e-8);
certified!(thurber, "Thurber", cubics, 1e-8);
certified!(mgh09, "MGH09", kowalik, 1e-8);
certified!(mgh10, "MGH10", meyer, 1e-8);
certified!(mgh17, "MGH17", osborne, 1e-8);
certified!(boxbod, "BoxBOD", saturating, 1e-9);
certified!(lanczos3, "Lanczos3", three_decays, 1e-7);

/// A decay towards a floor.
fn decay(x: f64, b: &[Number]) -> Number {
    b[0] + b[1] * (-b[2] * number(x)).exp()
}

const DECAY: [(f64, f64); 10] = [
    (0.0, 10.1),
    (1.0, 7.2),
    (2.0, 5.4),
    (3.0, 4.1),
    (4.0, 3.45),
    (5.0, 2.9),
    (6.0, 2.62),
    (8.0, 2.31),
    (10.0, 2.12),
    (12.0, 2.08),
];

fn bounded(bounds: [(f64, f64); 3], start: [f64; 3]) -> LeastSquaresFit {
    let mut curve = Curve { model: decay, points: &DECAY, parameters: 3 };
    let settings = Settings { bounds: bounds.to_vec(), ..Settings::default() };
    let found = minimise(&mut curve, &start, &settings).unwrap();
    assert!(found.outcome.converged(), "{found:?}");
    found
}

const NONE: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);

/// SciPy 1.17.1, `scipy.optimize.least_squares` (method lm; with bounds trf, then lm of the
/// parameters that are free).
#[test]
fn bounds_as_scipy_has_them() {
    let cases = [
        (
            [NONE; 3],
            [1.0, 5.0, 1.0],
            [2.048_168_480_5, 8.050_891_240_26, 0.444_520_443_29],
            [None; 3],
        ),
        (
            [(2.3, f64::INFINITY), NONE, NONE],
            [3.0, 5.0, 1.0],
            [2.3, 7.863_402_374_68, 0.486_009_096_32],
            [Some(Side::Lower), None, None],
        ),
        (
            [NONE, NONE, (f64::NEG_INFINITY, 0.3)],
            [1.0, 5.0, 0.1],
            [1.355_774_190_72, 8.082_463_326_49, 0.3],
            [None, None, Some(Side::Upper)],
        ),
        (
            [(2.3, f64::INFINITY), (f64::NEG_INFINITY, 7.5), NONE],
            [3.0, 5.0, 0.1],
            [2.3, 7.5, 0.465_549_734_55],
            [Some(Side::Lower), Some(Side::Upper), None],
        ),
    ];
    for (bounds, start, expected, sides) in cases {
        let found = bounded(bounds, start);
        agrees("bounded", &found.parameters, &expected, 1e-8);
        assert_eq!(found.on_bound, sides);
    }
}

/// A start on the wrong bound leaves it, and one outside begins on it.
#[test]
fn a_bound_lets_go() {
    for start in [[2.0, 5.0, 0.4], [-7.0, 99.0, 0.4], [3.0, 20.0, 0.01]] {
        let found = bounded([(2.0, 3.0), (5.0, 20.0), (0.01, 3.0)], start);
        agrees(
            "inside",
            &found.parameters,
            &[2.048_168_480_5, 8.050_891_240_26, 0.444_520_443_29],
            1e-8,
        );
        assert_eq!(found.on_bound, [None; 3]);
    }
}

/// What sits on a bound has no standard error, and the others have that of the smaller problem.
#[test]
fn a_parameter_on_its_bound_is_not_free() {
    let found = bounded([(2.3, f64::INFINITY), NONE, NONE], [3.0, 5.0, 1.0]);
    let covariance = found.covariance().unwrap();
    assert_eq!(covariance.parameters, [1, 2]);
    assert_eq!(covariance.standard_error(0), None);
    assert_eq!(found.degrees_of_freedom(), 8);
    let columns = &found.jacobian[found.residuals.len()..];
    let dot = |a: usize, b: usize| -> f64 {
        let n = DECAY.len();
        columns[a * n..][..n].iter().zip(&columns[b * n..][..n]).map(|(x, y)| x * y).sum()
    };
    let determinant = dot(0, 0) * dot(1, 1) - dot(0, 1) * dot(0, 1);
    let expected = [(dot(1, 1) / determinant).sqrt(), (dot(0, 0) / determinant).sqrt()];
    let got = [covariance.standard_error(1).unwrap(), covariance.standard_error(2).unwrap()];
    agrees("errors", &got, &expected, 1e-10);
    let correlation = -dot(0, 1) / (dot(0, 0) * dot(1, 1)).sqrt();
    agrees("correlation", &[covariance.correlation(1, 2).unwrap()], &[correlation], 1e-10);
}

/// The mean of n measurements with deviation s and a prior m0 ± s0: weights n/s^2 and 1/s0^2.
#[test]
fn a_prior_is_one_more_measurement() {
    let points = [(0.0, 4.0), (0.0, 5.0), (0.0, 7.0)];
    let mut mean = Curve { model: |_, b| b[0] / number(0.5), points: &points, parameters: 1 };
    let prior = Prior { parameter: 0, value: 1.0, sigma: 0.25 };
    let settings = Settings { priors: vec![prior], ..Settings::default() };
    let found = minimise(&mut mean, &[30.0], &settings).unwrap();
    // residuals (b - y/2) / 0.5: weight 4 each
    let weight = 3.0 * 4.0 + 16.0;
    let expected = (4.0 * (2.0 + 2.5 + 3.5) + 16.0 * 1.0) / weight;
    agrees("prior", &found.parameters, &[expected], 1e-12);
    assert_eq!((found.data, found.residuals.len()), (3, 4));
    let covariance = found.covariance().unwrap();
    agrees("deviation", &[covariance.standard_error(0).unwrap()], &[weight.sqrt().recip()], 1e-12);
}

/// a b x: only the product is determined, and a prior on one of them decides both.
#[test]
fn what_cannot_be_separated_is_seen() {
    let points = [(1.0, 6.0), (2.0, 12.1), (3.0, 17.8)];
    let mut product =
        Curve { model: |x, b| b[0] * b[1] * number(x), points: &points, parameters: 2 };
    let found = minimise(&mut product, &[1.0, 1.0], &Settings::default()).unwrap();
    assert!(found.outcome.converged());
    assert_eq!(found.covariance(), None);
    let spectrum = found.spectrum(&found.parameters, 1e-8).unwrap();
    assert_eq!(spectrum.rank, 1);
    let unseen = &spectrum.unseen()[0];
    agrees("unseen", &[unseen[0] / unseen[1]], &[-1.0], 1e-10);

    let priors = vec![Prior { parameter: 0, value: 4.0, sigma: 0.1 }];
    let known =
        minimise(&mut product, &[1.0, 1.0], &Settings { priors, ..Settings::default() }).unwrap();
    let slope = (6.0 + 24.2 + 53.4) / 14.0;
    agrees("known", &known.parameters, &[4.0, slope / 4.0], 1e-9);
    assert!(known.covariance().is_some());
}

/// A matrix whose singular values are known: 3 and 1 along (1, 1) and (1, -1) over sqrt(2).
#[test]
fn the_spectrum_of_a_known_matrix() {
    let spectrum = Spectrum::new(&[2.0, 1.0, 0.0, 1.0, 2.0, 0.0], &[1.0, 1.0], 1e-8).unwrap();
    agrees("values", &spectrum.values, &[3.0, 1.0], 1e-14);
    agrees("direction", &[spectrum.directions[0][0] / spectrum.directions[0][1]], &[1.0], 1e-14);
    let scaled = Spectrum::new(&[2e3, 1e3, 0.0, 1e-3, 2e-3, 0.0], &[1e-3, 1e3], 1e-8).unwrap();
    agrees("scaled", &scaled.values, &[3.0, 1.0], 1e-14);
}

/// ln(b x): a step to negative b has no value, and is taken shorter.
#[test]
fn where_the_model_has_no_value_the_step_is_shorter() {
    let points = [(1.0, -2.0), (2.0, -2.0 + 2_f64.ln())];
    let mut curve = Curve { model: |x, b| (b[0] * number(x)).ln(), points: &points, parameters: 1 };
    let found = minimise(&mut curve, &[5.0], &Settings::default()).unwrap();
    assert!(found.outcome.converged());
    agrees("ln", &found.parameters, &[(-2_f64).exp()], 1e-9);
    let nowhere = minimise(&mut curve, &[-5.0], &Settings::default()).unwrap();
    assert_eq!(nowhere.outcome, Termination::NotConverged(Stop::StartNotFinite));
}

/// A model whose derivative has the wrong sign.
struct Liar;

impl Residuals for Liar {
    fn parameters(&self) -> usize {
        1
    }

    fn evaluate(&mut self, p: &[f64], _: bool) -> Evaluated {
        Ok((vec![p[0] - 3.0], vec![-1.0]))
    }
}

#[test]
fn a_search_that_gets_nowhere_says_so() {
    let lied = minimise(&mut Liar, &[1.0], &Settings::default()).unwrap();
    assert_eq!(lied.outcome, Termination::NotConverged(Stop::Stalled));
    let set = Certified::read(include_str!("nist/Hahn1.dat"));
    let mut curve = Curve { model: cubics, points: &set.points, parameters: 7 };
    let settings = Settings { iterations: 3, ..Settings::default() };
    let short = minimise(&mut curve, &set.starts[0], &settings).unwrap();
    assert_eq!(short.outcome, Termination::NotConverged(Stop::Iterations));
    assert_eq!(short.iterations, 3);
}

/// A line through ten points whose values are off by up to 1e-6, each time by something else, with
/// derivatives times `slope`.
struct Blurred {
    slope: f64,
}

impl Residuals for Blurred {
    fn parameters(&self) -> usize {
        2
    }

    fn evaluate(&mut self, p: &[f64], _: bool) -> Evaluated {
        let blur = |i: f64| 1e-6 * ((p[0] + 3.0 * p[1]) * 1e9 + i).sin();
        let at = |(i, y): (f64, f64)| p[0] + p[1] * i - y + blur(i);
        let points = (0..10).map(|i| (f64::from(i), [0.1, 1.3, 1.9, 3.2][i as usize % 4]));
        let slopes = (0..10).map(|i| self.slope * f64::from(i)).collect();
        Ok((points.map(at).collect(), [vec![self.slope; 10], slopes].concat()))
    }
}

/// A model that is computed to 1e-6 has its minimum where no step lowers the misfit any more; one
/// whose derivatives are wrong has none there.
#[test]
fn errors_of_the_model_are_no_reason_to_stall() {
    let found = |slope: f64| {
        let error = 1e-6 * 10_f64.sqrt();
        let settings = Settings { error, gradient: 1e-12, ..Settings::default() };
        minimise(&mut Blurred { slope }, &[3.0, -2.0], &settings).unwrap()
    };
    let blurred = found(1.0);
    assert!(blurred.outcome.converged(), "{:?}", blurred.outcome);
    // numpy 1.24.2: np.polyfit(range(10), ([0.1, 1.3, 1.9, 3.2] * 3)[:10], 1)
    for (found, expected) in blurred.parameters.iter().zip([1.27090909090909, 0.03757575757575766])
    {
        assert!((found - expected).abs() < 3e-6, "{found} is not {expected}");
    }
    assert_eq!(found(-1.0).outcome, Termination::NotConverged(Stop::Stalled));
}

/// `a + 1`, with a value for positive `a` only.
struct Walled;

impl Residuals for Walled {
    fn parameters(&self) -> usize {
        1
    }

    fn evaluate(&mut self, p: &[f64], _: bool) -> Evaluated {
        let value = if p[0] > 0.0 { p[0] + 1.0 } else { f64::NAN };
        Ok((vec![value], vec![1.0]))
    }
}

#[test]
fn a_search_that_runs_against_a_wall_says_so() {
    let found = minimise(&mut Walled, &[1.0], &Settings::default()).unwrap();
    assert_eq!(found.outcome, Termination::NotConverged(Stop::Edge));
}

#[test]
fn bad_settings_are_refused() {
    let mut curve = Curve { model: decay, points: &DECAY, parameters: 3 };
    let mut code = |start: &[f64], settings: Settings| match minimise(&mut curve, start, &settings)
    {
        Err(error) => error.code(),
        Ok(found) => panic!("{found:?}"),
    };
    let with_bounds =
        |bounds: &[(f64, f64)]| Settings { bounds: bounds.to_vec(), ..Settings::default() };
    let with_prior = |parameter, sigma| Settings {
        priors: vec![Prior { parameter, value: 1.0, sigma }],
        ..Settings::default()
    };
    assert_eq!(code(&[1.0], Settings::default()), "fit::parameters");
    assert_eq!(code(&[1.0; 3], with_bounds(&[NONE])), "fit::parameters");
    assert_eq!(code(&[1.0; 3], with_bounds(&[NONE, (2.0, 2.0), NONE])), "fit::bounds");
    assert_eq!(code(&[1.0; 3], with_bounds(&[NONE, (f64::NAN, 2.0), NONE])), "fit::bounds");
    assert_eq!(code(&[1.0; 3], with_prior(3, 1.0)), "fit::parameters");
    assert_eq!(code(&[1.0; 3], with_prior(1, 0.0)), "fit::prior");
    let error: LeastSquaresError = LeastSquaresError::Bounds { parameter: 1 };
    assert_eq!(error.to_string(), "the least value of parameter 1 is not below its greatest");
}
