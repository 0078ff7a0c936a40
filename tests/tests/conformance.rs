//! Every link of the registry keeps its contract on thousands of random paths, with parameters drawn around
//! the example of its card.
//!
//! Claims (see [`trilith_element::conformance`]): pure, finite, continuous where a step begins, tangents that
//! are derivatives, energies that balance with the work, no energy from a passive law. A case is a list of numbers
//! between −1 and 1; with all of them 0 it is the example itself, towards which proptest shrinks.

use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestRng, TestRunner};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;
use trilith::Registry;
use trilith::exercise::Specimen;
use trilith_element::conformance::{ConformanceError, Kit};
use trilith_element::{
    Card, Form, Frame, Geometry, Link, Parameter, ParameterError, ReadConstraint, ReadFunction,
    ReadLinear, ReadLink, ReadOutput, ReadSolver, Register, Value, Values,
};

/// Laws that may give energy, each with the reason why that is right.
const ACTIVE: &[(&str, &str)] = &[
    (
        "LinearLink",
        "an unsymmetric stiffness does work in a circuit, as the oil film of a bearing does",
    ),
    (
        "FrictionPendulum",
        "without `rise` the slope turns the normal force and the height does not change",
    ),
    ("TriplePendulum", "as a friction pendulum without `rise`"),
    ("Actuator", "it pushes by itself"),
];

/// Paths with each set of parameters.
const PATHS: usize = 8;
/// Sets of parameters for each link: 1400 paths in a release build.
const SETS: u32 = if cfg!(debug_assertions) { 25 } else { 175 };
/// Numbers of a case: parameters first, then the size of the motion.
const NUMBERS: usize = 64;
/// A parameter goes up to so many times its value in the example, or down.
const SPREAD: f64 = 3.0;
/// Mass that strikes a contact with a restitution, kg.
const STRIKING: f64 = 1000.0;

/// The links of a registry with their readers.
#[derive(Default)]
struct Links(Vec<(&'static Card, ReadLink)>);

impl Register for Links {
    fn add_linear(&mut self, _: &'static Card, _: ReadLinear) {}
    fn add_constraint(&mut self, _: &'static Card, _: ReadConstraint) {}
    fn add_function(&mut self, _: &'static Card, _: ReadFunction) {}
    fn add_output(&mut self, _: &'static Card, _: ReadOutput) {}
    fn add_solver(&mut self, _: &'static Card, _: ReadSolver) {}
    fn add_link(&mut self, card: &'static Card, read: ReadLink) {
        self.0.push((card, read));
    }
}

/// A value drawn around that of the example. Lists and matrices keep their shape: one factor for all.
fn drawn(parameter: Option<&Parameter>, value: &Value, x: f64) -> Value {
    fn times(value: &Value, factor: f64) -> Value {
        match value {
            Value::Number(n) => Value::Number(n * factor),
            Value::List(items) => Value::List(items.iter().map(|v| times(v, factor)).collect()),
            other => other.clone(),
        }
    }
    // One time in five a choice is another one, a flag the other way.
    let other = x.abs() > 0.8;
    match (value, parameter) {
        (Value::Flag(b), _) => Value::Flag(*b != other),
        (Value::Text(_), Some(Parameter { form: Form::Choice(names), .. })) if other => {
            let at = ((x.abs() - 0.8) / 0.2 * names.len() as f64) as usize;
            Value::Text(names[at.min(names.len() - 1)].to_owned())
        }
        (Value::Number(_) | Value::List(_), Some(p)) => {
            let scaled = times(value, SPREAD.powf(x));
            match scaled {
                Value::Number(n) if !p.range.contains(n) => value.clone(),
                scaled => scaled,
            }
        }
        _ => value.clone(),
    }
}

/// A law with a dashpot in place of a restitution: there is no structure to take a mass from.
fn settled(law: Box<dyn Link>) -> Box<dyn Link> {
    let wanted = law.impact().and_then(|i| Some((i.restitution?, i.mass.unwrap_or(STRIKING))));
    wanted.and_then(|(e, mass)| law.restituting(e, mass)).unwrap_or(law)
}

fn examine(
    card: &Card,
    read: &ReadLink,
    (example, nodes): (&Values, usize),
    numbers: &[f64],
    seed: u64,
) -> Result<(), TestCaseError> {
    let values = example.0.iter().zip(numbers);
    let values = values.map(|((n, v), x)| (n.clone(), drawn(card.parameter(n), v, *x))).collect();
    let values = Values(values);
    // Parameters that exclude each other are no law.
    let no_law = |e: ParameterError| TestCaseError::reject(e.to_string());
    let mut law = read(&values).map_err(no_law)?;
    // As far apart as in an exercise.
    let places = [[0.0; 3], [1.0, 0.0, 0.0]];
    let nodes = &places[..nodes];
    let frame = Frame::of_nodes(nodes, None, None).map_err(no_law)?;
    law.place(&Geometry::new(nodes, frame)).map_err(no_law)?;
    let law = settled(law);
    if law.coordinates().len() != card.exercise.strokes.len() {
        return Err(TestCaseError::reject("the exercise is for other coordinates"));
    }
    let size = SPREAD.powf(numbers[NUMBERS - 1]);
    let kit = Kit::of(&card.exercise).scaled(size).seed(seed).paths(PATHS).quick();
    let kit = if ACTIVE.iter().any(|(kind, _)| *kind == card.kind) { kit.active() } else { kit };
    let told = |e| match e {
        // It says itself that it does not go so far.
        ConformanceError::Refuses { .. } => TestCaseError::reject(e.to_string()),
        e => TestCaseError::fail(format!("{} with {values:?}, motion × {size}: {e}", card.kind)),
    };
    kit.check(law.as_ref()).map(drop).map_err(told)
}

/// What is wrong with a link, in words.
fn judged(registry: &Registry, card: &'static Card, read: &ReadLink) -> Result<(), String> {
    let started = Instant::now();
    let specimen = Specimen::new(registry, card.kind, &[])
        .map_err(|error| format!("the example of {}: {error}", card.kind))?;
    let (nodes, example) = (specimen.nodes().len(), specimen.values);
    assert!(example.0.len() < NUMBERS, "{} has many parameters", card.kind);
    let config = Config {
        cases: SETS,
        max_global_rejects: 20 * SETS,
        failure_persistence: None,
        ..Config::default()
    };
    let random = TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]);
    let mut runner = TestRunner::new_with_rng(config, random);
    let case = (proptest::collection::vec(-1.0..1.0, NUMBERS), proptest::num::u64::ANY);
    let result =
        runner.run(&case, |(numbers, seed)| examine(card, read, (&example, nodes), &numbers, seed));
    let took = started.elapsed().as_secs_f64();
    eprintln!("{}: {} paths in {took:.1} s", card.kind, SETS as usize * PATHS);
    result.map_err(|error| error.to_string().chars().take(1500).collect())
}

#[test]
fn every_link_keeps_its_contract_on_random_paths_with_random_parameters() {
    let mut links = Links::default();
    trilith_tests::register(&mut links);
    let registry = trilith_tests::registry();
    // Each thread takes the next link; what is told is told in their order.
    let (next, wrong) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let at = next.fetch_add(1, Ordering::Relaxed);
                    let Some((card, read)) = links.0.get(at) else { break };
                    if let Err(error) = judged(&registry, card, read) {
                        wrong.lock().unwrap().push((at, error));
                    }
                }
            });
        }
    });
    let mut wrong = wrong.into_inner().unwrap();
    wrong.sort();
    let wrong: Vec<String> = wrong.into_iter().map(|(_, error)| error).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}
