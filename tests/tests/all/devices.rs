//! Steps on graphics cards: as texts, compiled without a card, and run on this processor by OpenCL (pocl).
//!
//! A test that needs OpenCL or NVIDIA's compiler says so and passes where there is none; with `COADJOINT_REQUIRE_TOOLS=1` it
//! fails. `COADJOINT_BLESS=1` rewrites the golden files.
#![allow(clippy::unwrap_used, clippy::panic)]

use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_codegen::step::{Origin, Step, StepError};
use coadjoint_codegen::system::{Options, read};
use coadjoint_native::cards::{
    Advanced, Api, Card, Device, DeviceError, ENDED, Refused, Status, compile,
};
use coadjoint_program::print::{DeviceLanguage, device_unit};
use coadjoint_program::states::{States, into_lane, of_lane};
use coadjoint_program::{
    Function, Graph, Id, Kernel, KernelParts, Precision, Programs, Stepper, WIDTH,
};
use coadjoint_tests::kernels::{smooth, unlimited};
use coadjoint_tests::sources::golden;
use nalgebra::DMatrix;

/// A state on its way.
#[derive(Clone, Debug, Default)]
struct OnDevice {
    g: Vec<f64>,
    mu: Vec<f64>,
    made: u64,
    /// True if it moves no further.
    ended: bool,
}

/// A step with its folded coefficients.
struct Ready {
    name: String,
    step: Step,
    slots: Vec<f64>,
}

impl Ready {
    fn kernel(&self) -> &Kernel {
        self.step.kernel()
    }

    fn identity(&self) -> Vec<f64> {
        let entries = self.kernel().programs.matrix.outputs().len();
        let rows = (entries as f64).sqrt() as usize;
        self.step.element_of(DMatrix::<f64>::identity(rows, rows).as_slice())
    }

    /// The steps that the interpreter makes of these.
    fn alone(&self, row: &mut OnDevice, steps: u64) -> u64 {
        let (kernel, mut slots) = (self.kernel(), self.slots.clone());
        if !self.step.moves() {
            return kernel.advance(&slots, &mut row.g, &mut row.mu, steps).steps;
        }
        let mut one = |number: &u64| {
            self.step.set_time(&mut slots, 0.1, *number as f64 * 0.1);
            kernel.advance(&slots, &mut row.g, &mut row.mu, 1).steps == 1
        };
        (0..steps).take_while(|number| one(number)).count() as u64
    }

    /// Rows of which the last but one is driven far too hard, and the last is no state.
    fn rows(&self, count: usize) -> Vec<OnDevice> {
        let row = |r: usize| {
            let size = if r + 2 == count { 1e8 } else { 0.4 + 0.5 * (r as f64 * 0.37).sin() };
            let mut mu = momentum(self.kernel().dim, size, r);
            if r + 1 == count {
                mu[0] = f64::NAN;
            }
            OnDevice { g: self.identity(), mu, made: 0, ended: false }
        };
        (0..count).map(row).collect()
    }
}

/// Steps of a Hamiltonian that moves in time.
fn driven() -> Ready {
    let smooth = smooth("SO3", "sqrt(1 + a^2/3 + b^2/4) + c^2/5 + cos(2*t)*a/4", 5);
    let step = Origin::from(smooth).step(Precision::Double).unwrap();
    let slots = step.fold(0.1, &[]).unwrap();
    Ready { name: "driven".to_owned(), step, slots }
}

fn momentum(n: usize, size: f64, seed: usize) -> Vec<f64> {
    (0..n).map(|i| size * (1.3 + 2.1 * i as f64 + 0.7 * seed as f64).sin()).collect()
}

fn ready(text: &str, truncation: usize, h: f64, precision: Precision) -> Ready {
    let integrator = integrator(text, truncation);
    let name = format!("{}, {precision}", integrator.problem.name);
    let step = Origin::from(integrator).step(precision).unwrap();
    let slots = unlimited(&step, h);
    Ready { name, step, slots }
}

fn integrator(text: &str, truncation: usize) -> Integrator {
    let options = Options { truncation: Some(truncation), ..Options::default() };
    Integrator::build(read(text, options).unwrap().problem, TermLimit::default()).unwrap()
}

const RIGID_BODY: &str = include_str!("../../../examples/rigid_body.toml");
const HEAVY_TOP: &str = include_str!("../../../examples/heavy_top.toml");

/// Tables, products, Cayley's chart, a comoving frame.
const OTHERS: [(&str, usize); 5] = [
    (
        "name = \"su3\"\ngroup = \"SU3\"\ncoordinates = [\"a\", \"b\", \"c\", \"d\", \"e\", \"f\", \"g\", \"h\"]\n\
         hamiltonian = \"a^2/3 + b^2/4 + c^2/5 + d^2/6 + e^2/7 + f^2/8 + g^2/9 + h^2/10\"\n",
        3,
    ),
    (
        "name = \"sl2\"\ngroup = \"SL2\"\ncoordinates = [\"a\", \"b\", \"c\"]\n\
         hamiltonian = \"a^2/5 + b^2/6 + c^2/7 + a*b/9\"\n[integrator]\nchart = \"cayley\"\n",
        5,
    ),
    (
        "name = \"two\"\ngroup = \"SO3*SE2\"\ncoordinates = [\"a\", \"b\", \"c\", \"d\", \"e\", \"f\"]\n\
         hamiltonian = \"a^2/3 + b^2/4 + c^2/5 + d^2/6 + e^2/7 + f^2/8 + a*d/9\"\n",
        3,
    ),
    (
        "name = \"cubic\"\ngroup = \"SU2\"\ncoordinates = [\"a\", \"b\", \"c\"]\n\
         hamiltonian = \"a^2/3 + b^2/4 + c^2/5 + a*b*c/9\"\n",
        5,
    ),
    (FRAMED, 7),
];

const FRAMED: &str = "name = \"framed\"\ngroup = \"SO3\"\ncoordinates = [\"a\", \"b\", \"c\"]\n\
     hamiltonian = \"a^2/3 + b^2/3.2 + c^2/4\"\n[integrator]\nframe = \"comoving\"\n";

/// Reports a missing tool; fails if tools are required.
fn missing(what: &str) {
    assert!(
        std::env::var_os("COADJOINT_REQUIRE_TOOLS").is_none_or(|value| value != "1"),
        "COADJOINT_REQUIRE_TOOLS is set, and {what}"
    );
    eprintln!("{what}: nothing was tried");
}

/// The kernel on the first device of OpenCL; `None` where there is none.
fn card(ready: &Ready) -> Option<Card> {
    let device = Device { api: Api::OpenCl, number: 0 };
    opened(Card::new(device, ready.kernel(), &ready.slots), &ready.name)
}

/// The kernel of this name on a device; `None` where there is no device.
fn opened(card: Result<Card, DeviceError>, name: &str) -> Option<Card> {
    match card {
        Ok(card) => Some(card),
        Err(error @ (DeviceError::NoLibrary { .. } | DeviceError::NoDevice { .. })) => {
            missing(&error.to_string());
            None
        }
        Err(error) => panic!("{name}: {error}"),
    }
}

fn bits(list: &[f64]) -> Vec<u64> {
    list.iter().map(|value| value.to_bits()).collect()
}

/// Moves rows on the device; `redo` gets each that it refuses, why, and the step to move it to.
fn driven_on(
    card: &mut Card,
    rows: &mut [OnDevice],
    steps: u64,
    mut redo: impl FnMut(&mut OnDevice, Status, u64),
) -> Advanced {
    let [element, dim] = rows.first().map_or([0; 2], |row| [row.g.len(), row.mu.len()]);
    let mut states = States::new(element, dim, rows.len());
    let block = |place: usize| place / WIDTH * (element + dim) * WIDTH;
    let put = |states: &mut States, place: usize, row: &OnDevice| {
        let own = &mut states.blocks_mut()[block(place)..];
        into_lane(own, place % WIDTH, [&row.g, &row.mu]);
    };
    let get = |states: &States, place: usize, row: &mut OnDevice| {
        let mut numbers = of_lane(&states.blocks()[block(place)..], place % WIDTH);
        row.g.iter_mut().chain(&mut row.mu).zip(&mut numbers).for_each(|(own, now)| *own = now);
    };
    rows.iter().enumerate().for_each(|(place, row)| put(&mut states, place, row));
    let count = |row: &OnDevice| if row.ended { ENDED } else { row.made };
    let mut made: Vec<u64> = rows.iter().map(count).collect();
    let mut others = |states: &mut States, made: &mut [u64], refused: &[Refused], target: u64| {
        for &Refused { place, why } in refused {
            let row = &mut rows[place];
            get(states, place, row);
            row.made = made[place];
            redo(row, why, target);
            put(states, place, row);
            made[place] = count(row);
        }
    };
    let advanced = card.advance(&mut states, &mut made, steps, &mut others, &|_| {}).unwrap();
    for (place, row) in rows.iter_mut().enumerate() {
        get(&states, place, row);
        row.made = if row.ended { row.made } else { made[place] };
    }
    advanced
}

/// Moves rows on the device; what it refuses ends there.
fn moved(card: &mut Card, rows: &mut [OnDevice], steps: u64) -> (Advanced, Vec<Status>) {
    let mut why = Vec::new();
    let advanced = driven_on(card, rows, steps, |row, reason, _| {
        row.ended = true;
        why.push(reason);
    });
    (advanced, why)
}

#[test]
fn texts_are_the_committed_ones() {
    let texts = [
        (DeviceLanguage::OpenCl, Precision::Single, "rigid_body.cl"),
        (DeviceLanguage::Cuda, Precision::Double, "rigid_body.cu"),
    ];
    for (language, precision, file) in texts {
        let ready = ready(RIGID_BODY, 3, 0.1, precision);
        let about = "rigid_body, K = 3, h = 0.1";
        golden(file, &device_unit(ready.kernel(), &ready.slots, language, about));
    }
}

#[test]
fn steps_on_a_device_have_the_bits_of_the_interpreter() {
    let mut list = vec![ready(RIGID_BODY, 7, 0.1, Precision::Double)];
    list.push(ready(HEAVY_TOP, 5, 0.05, Precision::Double));
    list.extend(OTHERS.map(|(text, truncation)| ready(text, truncation, 0.2, Precision::Double)));
    list.push(driven());
    for ready in &list {
        let Some(mut card) = card(ready) else { return };
        // Neither a multiple of what cards take together, nor of a block.
        let (count, steps) = (203, 600);
        let mut rows = ready.rows(count);
        let mut expected = rows.clone();
        let (advanced, why) = moved(&mut card, &mut rows, steps);
        assert_eq!(advanced.pieces, 1);
        let mut refused = 0;
        for (place, (own, row)) in expected.iter_mut().zip(&rows).enumerate() {
            let made = ready.alone(own, steps);
            refused += usize::from(made < steps);
            assert_eq!(row.made, made, "{}, row {place}", ready.name);
            assert_eq!(row.ended, made < steps, "{}, row {place}", ready.name);
            assert_eq!(bits(&row.g), bits(&own.g), "{}, row {place}", ready.name);
            assert_eq!(bits(&row.mu), bits(&own.mu), "{}, row {place}", ready.name);
        }
        assert!((2..count / 2).contains(&refused), "{}: {refused} refused", ready.name);
        assert_eq!((why.len(), advanced.refused), (refused, refused as u64));
        // In pieces of other sizes, and cut at the end of a block, the same.
        let mut pieces = ready.rows(count);
        card.limit(64);
        assert_eq!(moved(&mut card, &mut pieces, 256).0.pieces, 4);
        moved(&mut card, &mut pieces, steps);
        for (place, (row, own)) in rows.iter().zip(&pieces).enumerate() {
            assert_eq!((row.made, row.ended), (own.made, own.ended), "{}, row {place}", ready.name);
            assert_eq!(bits(&row.g), bits(&own.g), "{}, row {place}", ready.name);
            assert_eq!(bits(&row.mu), bits(&own.mu), "{}, row {place}", ready.name);
        }
    }
}

/// A kernel whose steps put functions of μ into g, and solve nothing.
fn functions() -> Kernel {
    const FUNCTIONS: [Function; 9] = [
        Function::Exp,
        Function::Ln,
        Function::Sin,
        Function::Cos,
        Function::Tan,
        Function::Atan,
        Function::Tanh,
        Function::Power(3, 2),
        Function::Power(-5, 3),
    ];
    let m = FUNCTIONS.len();
    let program = |inputs: usize, of: &dyn Fn(&Graph) -> Vec<Id>| {
        let graph = Graph::new();
        let outputs = of(&graph);
        graph.finish(inputs, &outputs)
    };
    let one = |graph: &Graph| vec![graph.constant(1.0)];
    let own = |graph: &Graph| vec![graph.input(0)];
    let programs = Programs {
        guess: program(1, &own),
        correct: program(2, &|graph| {
            let zero = graph.zero();
            vec![graph.input(0), graph.input(1), zero, zero]
        }),
        accept: program(4, &one),
        transport: program(m + 2, &|graph| {
            let mu = graph.input(m);
            let mut outputs = FUNCTIONS.map(|function| graph.function(function, mu)).to_vec();
            let factor = graph.constant(-1.01);
            outputs.push(graph.mul(mu, factor));
            outputs
        }),
        frame: None,
        sound: program(m + 1, &one),
        watch: program(m + 1, &own),
        matrix: program(m, &own),
    };
    let (tolerance, near, corrections) = (0.5, 1.0, 1);
    Kernel::new(KernelParts {
        dim: 1,
        element: m,
        unknowns: 1,
        solution: 1,
        tolerance,
        near,
        corrections,
        programs,
    })
    .unwrap()
}

#[test]
fn functions_on_a_device_have_the_bits_of_the_interpreter() {
    let kernel = functions();
    let device = Device { api: Api::OpenCl, number: 0 };
    let Some(mut card) = opened(Card::new(device, &kernel, &[]), "functions") else { return };
    let row = |r: usize| {
        let size = 2_f64.powi(r as i32 % 40 - 20);
        OnDevice { g: vec![0.0; 9], mu: momentum(1, size, r), made: 0, ended: false }
    };
    let mut rows: Vec<OnDevice> = (0..500).map(row).collect();
    let before = rows.clone();
    moved(&mut card, &mut rows, 3);
    // Which of the many NaNs comes out is left open by IEEE 754.
    let bits = |list: &[f64]| -> Vec<Option<u64>> {
        list.iter().map(|value| (!value.is_nan()).then_some(value.to_bits())).collect()
    };
    for (mut own, row) in before.into_iter().zip(&rows) {
        assert_eq!(kernel.advance(&[], &mut own.g, &mut own.mu, 3).steps, 3);
        assert_eq!((row.made, bits(&row.g)), (3, bits(&own.g)), "functions of {:?}", own.mu);
    }
    // And as texts for cards of NVIDIA, which say how they round.
    let text = device_unit(&kernel, &[], DeviceLanguage::Cuda, "functions");
    assert!(text.contains("NUMBER scaled(") && text.contains("__dmul_rn(a, __longlong_as_double("));
}

#[test]
fn a_device_says_why_a_step_is_refused() {
    let ready = ready(RIGID_BODY, 7, 0.1, Precision::Double);
    let Some(mut card) = card(&ready) else { return };
    let start =
        |mu: [f64; 3], g: [f64; 4]| OnDevice { g: g.into(), mu: mu.into(), ..OnDevice::default() };
    let one = [1.0, 0.0, 0.0, 0.0];
    let mut rows = vec![
        start([0.3, 0.1, 0.2], one),
        start([0.3, f64::NAN, 0.2], one),
        start([3e9, 1e9, 2e9], one),
        start([0.3, 0.1, 0.2], [0.0, 0.0, 0.0, 0.0]),
        // One turn a step and more about an axis: solved at once, but beyond the chart.
        start([0.0, 0.0, 200.0], one),
    ];
    let before = rows.clone();
    let (_, why) = moved(&mut card, &mut rows, 10);
    assert_eq!(why.len(), 4, "{why:?}");
    assert_eq!((why[2], why[3]), (Status::Unsound, Status::Outside));
    assert!(matches!(why[0], Status::Unsolved | Status::Far), "{why:?}");
    assert!(matches!(why[1], Status::Unsolved | Status::Far | Status::Outside), "{why:?}");
    assert_eq!(rows[0].made, 10);
    for (row, before) in rows.iter().zip(&before).skip(1) {
        assert!(row.ended && row.made == 0);
        assert_eq!((bits(&row.g), bits(&row.mu)), (bits(&before.g), bits(&before.mu)));
    }
}

#[test]
fn refused_rows_are_moved_by_the_caller_and_go_on() {
    let ready = ready(RIGID_BODY, 7, 0.1, Precision::Double);
    let Some(mut card) = card(&ready) else { return };
    let mut rows = ready.rows(20);
    let mut seen = Vec::new();
    // The state that the device could not move is put back to a good one.
    let advanced = driven_on(&mut card, &mut rows, 2000, |row, _, target| {
        row.mu = vec![0.1, 0.2, 0.3];
        row.made = target;
        seen.push(target);
    });
    assert_eq!((seen.as_slice(), advanced.refused), (&[256, 256][..], 2));
    assert!(rows.iter().all(|row| row.made == 2000 && !row.ended));
    let (mut g, mut mu) = (ready.identity(), vec![0.1, 0.2, 0.3]);
    assert_eq!(ready.kernel().advance(&ready.slots, &mut g, &mut mu, 2000 - 256).steps, 1744);
    assert_eq!((bits(&rows[18].g), bits(&rows[18].mu)), (bits(&g), bits(&mu)));
}

/// Of 32 bits: one step to rounding, momentum and Casimirs kept, back to where it came from.
#[test]
fn single_precision_keeps_the_laws_to_its_rounding() {
    let (u, h) = (f64::from(f32::EPSILON) / 2.0, 0.1);
    let systems = [(RIGID_BODY, 7), (HEAVY_TOP, 5), OTHERS[0], OTHERS[1], OTHERS[2], OTHERS[3]];
    for (text, truncation) in systems {
        let single = ready(text, truncation, h, Precision::Single);
        let back = ready(text, truncation, -h, Precision::Single);
        let double = ready(text, truncation, h, Precision::Double);
        let (Some(mut card), Some(mut reverse)) = (card(&single), self::card(&back)) else {
            return;
        };
        let name = &single.name;
        let n = single.kernel().dim;
        let mut rows = single.rows(102);
        rows.truncate(100);
        for row in &mut rows {
            row.mu.iter_mut().for_each(|value| *value = f64::from(*value as f32));
        }
        let start = rows.clone();
        // A step is that of double precision.
        let (_, why) = moved(&mut card, &mut rows, 1);
        assert_eq!(why, [], "{name}");
        for (row, before) in rows.iter().zip(&start) {
            let (mut g, mut mu) = (before.g.clone(), before.mu.clone());
            assert_eq!(double.kernel().advance(&double.slots, &mut g, &mut mu, 1).steps, 1);
            let scale = mu.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
            for (own, exact) in row.mu.iter().zip(&mu) {
                assert!((own - exact).abs() <= 8.0 * n as f64 * u * scale, "{name}: {own} {exact}");
            }
            for (own, exact) in row.g.iter().zip(&g) {
                assert!((own - exact).abs() <= 8.0 * n as f64 * u, "{name}: {own} {exact}");
            }
        }
        // Casimirs and energy after many.
        let steps = 1000;
        let mut rows = start.clone();
        let (_, why) = moved(&mut card, &mut rows, steps);
        assert_eq!(why, [], "{name}");
        let watched = |row: &OnDevice| double.kernel().watch(&double.slots, &row.g, &row.mu);
        // Roundings of a random walk, fifteen deviations wide; a matrix of a group by tables multiplies them.
        let kept = 15.0 * u * (steps as f64).sqrt() * n as f64;
        for (row, before) in rows.iter().zip(&start) {
            for (now, then) in watched(row).iter().zip(watched(before)).skip(1) {
                assert!((now - then).abs() <= kept * then.abs().max(1.0), "{name}: {now} {then}");
            }
        }
        // There and back.
        let mut rows = start.clone();
        let steps = 100;
        moved(&mut card, &mut rows, steps);
        let farthest =
            |row: &OnDevice| row.g.iter().chain(&row.mu).fold(1.0_f64, |a, b| a.max(b.abs()));
        let sizes: Vec<f64> = rows.iter().map(farthest).collect();
        for row in &mut rows {
            row.made = 0;
        }
        let (_, why) = moved(&mut reverse, &mut rows, steps);
        assert_eq!(why, [], "{name}");
        for ((row, before), size) in rows.iter().zip(&start).zip(sizes) {
            for (now, then) in row.g.iter().chain(&row.mu).zip(before.g.iter().chain(&before.mu)) {
                assert!((now - then).abs() <= 10.0 * kept * size, "{name}: {now} {then}");
            }
        }
    }
}

#[test]
fn frames_and_times_in_single_precision_are_refused() {
    let integrator = integrator(FRAMED, 7);
    let refused = Origin::from(integrator).step(Precision::Single).unwrap_err();
    assert_eq!(refused, StepError::SingleFrame);
    let moving = smooth("SO3", "a^2/3 + b^2*cos(t)", 5);
    let refused = Origin::from(moving).step(Precision::Single).unwrap_err();
    assert_eq!(refused, StepError::SingleTime);
}

#[test]
fn a_device_that_is_not_there_is_one_line() {
    let ready = ready(RIGID_BODY, 3, 0.1, Precision::Double);
    for api in [Api::OpenCl, Api::Cuda] {
        let device = Device { api, number: 4711 };
        let error = Card::new(device, ready.kernel(), &ready.slots).unwrap_err();
        let expected = matches!(
            error,
            DeviceError::NoDevice { .. }
                | DeviceError::NoLibrary { .. }
                | DeviceError::Failed { .. }
        );
        assert!(expected, "{error:?}");
        assert!(!error.to_string().contains('\n'), "{error}");
    }
}

#[test]
fn the_texts_compile_for_cards_without_a_card() {
    let mut list = Vec::new();
    for precision in [Precision::Double, Precision::Single] {
        list.push(ready(RIGID_BODY, 7, 0.1, precision));
        list.push(ready(HEAVY_TOP, 3, 0.05, precision));
        list.push(ready(OTHERS[1].0, OTHERS[1].1, 0.1, precision));
    }
    list.push(ready(FRAMED, 7, 0.1, Precision::Double));
    list.push(driven());
    for ready in &list {
        let Some(compiled) = compile(ready.kernel(), &ready.slots, "sm_90") else {
            return missing("NVIDIA's compiler NVRTC is not on this machine");
        };
        let compiled = compiled.unwrap_or_else(|error| panic!("{}: {error}", ready.name));
        // Machine code is a file of the format ELF.
        assert_eq!(&compiled.code[..4], b"\x7fELF", "{}", ready.name);
        let said = compiled.log.lines().find(|line| line.contains("registers")).unwrap_or_default();
        let spilt = compiled.log.lines().find(|line| line.contains("spill")).unwrap_or_default();
        eprintln!("{}: {} ({})", ready.name, said.trim(), spilt.trim());
    }
    // The error of a kernel that does not compile is one line.
    let error = compile(list[0].kernel(), &list[0].slots, "sm_1").unwrap().unwrap_err();
    assert!(error.contains("arch") && !error.contains('\n'), "{error}");
}
