//! The tumbling of asteroid 4179 Toutatis.
//!
//! Radar (R. S. Hudson, S. J. Ostro, *Science* 270 (1995) 84): a long-axis mode with periods of
//! 5.41 d (rotation about the long axis) and 7.35 d (mean precession of the long axis about the
//! angular momentum), dimensions 1.92 × 2.40 × 4.60 km along the principal axes, moments of inertia
//! in the ratios 3.22 : 3.09 : 1. From these the state follows; nothing else is put in.
//!
//! Axes: 1 long, 2 intermediate, 3 short. Units: day, and I₁ = 1.

use std::f64::consts::TAU;

use coadjoint::nalgebra::Vector3;
use coadjoint::systems::FreeBody;
use coadjoint::{LieGroup, Phase, SO3, StepError};

use crate::elliptic::{complete_first, complete_third, jacobi};

/// I₁, I₂, I₃ in units of the moment about the long axis.
pub const INERTIA: [f64; 3] = [1.0, 3.09, 3.22];
/// Rotation about the long axis, in days.
pub const ROTATION: f64 = 5.41;
/// Mean precession of the long axis, in days.
pub const PRECESSION: f64 = 7.35;
/// B. E. A. Mueller, M. J. S. Belton, N. H. Samarasinha, Bull. Amer. Astron. Soc. 32 (2000) 8.08:
/// periodicities of the 1992/93 light curve per day, each ± 0.008.
pub const MEASURED: [f64; 3] = [0.135, 0.271, 0.643];
/// Semiaxes of the ellipsoid, long, intermediate, short, in km.
pub const SEMIAXES: [f64; 3] = [2.30, 1.20, 0.96];

/// A free body rotating about its long axis (2 E I₁ < L² < 2 E I₂), by its integrals.
#[derive(Clone, Copy, Debug)]
pub struct LongAxisMode {
    /// L², the square of the angular momentum.
    pub momentum_squared: f64,
    pub twice_energy: f64,
}

/// The free body's motion in closed form (Landau and Lifshitz, *Mechanics*, § 37, indices 1 and 3
/// exchanged): Π = (A₁ dn λt, A₂ sn λt, A₃ cn λt).
#[derive(Clone, Copy, Debug)]
pub struct ClosedForm {
    amplitudes: [f64; 3],
    rate: f64,
    modulus: f64,
}

impl LongAxisMode {
    pub fn closed_form(&self) -> ClosedForm {
        let [i1, i2, i3] = INERTIA;
        let Self { momentum_squared: l2, twice_energy: e2 } = *self;
        let (above, below) = (e2 * i3 - l2, l2 - e2 * i1);
        ClosedForm {
            amplitudes: [
                (i1 * above / (i3 - i1)).sqrt(),
                (i2 * below / (i2 - i1)).sqrt(),
                (i3 * below / (i3 - i1)).sqrt(),
            ],
            rate: ((i2 - i1) * above / (i1 * i2 * i3)).sqrt(),
            modulus: ((i3 - i2) * below / ((i2 - i1) * above)).sqrt(),
        }
    }

    /// The period of the rotation about the long axis, 4 K(k)/λ.
    pub fn rotation_period(&self) -> f64 {
        let motion = self.closed_form();
        4.0 * complete_first(motion.modulus) / motion.rate
    }

    /// The mean period of the long axis' precession about the angular momentum.
    ///
    /// φ̇ = L (2E − Π₁²/I₁)/(L² − Π₁²), whose mean over the period is
    /// L/I₁ + L (2E − L²/I₁)/A₃² · Π(−n, k)/K(k), n = k² A₁²/A₃².
    pub fn precession_period(&self) -> f64 {
        let ClosedForm { amplitudes: [a1, _, a3], modulus: k, .. } = self.closed_form();
        let length = self.momentum_squared.sqrt();
        let n = (k * a1 / a3).powi(2);
        let mean = complete_third(-n, k) / complete_first(k);
        let slow = (self.twice_energy - self.momentum_squared / INERTIA[0]) / (a3 * a3);
        TAU / (length * (1.0 / INERTIA[0] + slow * mean))
    }

    /// The mode with these two periods: their ratio fixes L²/2E, by bisection between the spin
    /// about the long axis and the separatrix; then the unit of time does the rest.
    ///
    /// `None` where no mode has this ratio.
    pub fn with_periods(rotation: f64, precession: f64) -> Option<Self> {
        let [i1, i2, _] = INERTIA;
        let mode = |x: f64| Self { momentum_squared: x, twice_energy: 1.0 };
        let ratio = |x: f64| {
            mode(x).precession_period() / mode(x).rotation_period() - precession / rotation
        };
        let (mut low, mut high) = (i1 + 1e-9, i2 - 1e-9);
        if ratio(low) * ratio(high) > 0.0 {
            return None;
        }
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if ratio(low) * ratio(middle) <= 0.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
        let found = mode(0.5 * (low + high));
        // Angular velocities, and so momenta, scale with 1/time.
        let scale = found.rotation_period() / rotation;
        Some(Self {
            momentum_squared: found.momentum_squared * scale * scale,
            twice_energy: scale * scale,
        })
    }
}

impl ClosedForm {
    pub fn momentum(&self, t: f64) -> Vector3<f64> {
        // Reduced to one period before the Landen steps blow the argument up.
        let period = 4.0 * complete_first(self.modulus);
        let (sn, cn, dn) = jacobi((self.rate * t) % period, self.modulus);
        let [a1, a2, a3] = self.amplitudes;
        Vector3::new(a1 * dn, a2 * sn, a3 * cn)
    }
}

/// Unit vectors to the observer and the Sun, in a frame with the angular momentum along z. The real geometry of 1992/93
/// changed quickly; this is one of its size, held fixed.
#[derive(Clone, Copy, Debug)]
pub struct Geometry {
    pub observer: Vector3<f64>,
    pub sun: Vector3<f64>,
}

impl Geometry {
    /// The observer at polar angle 60°, the Sun at 75° and 40° ahead in longitude: a solar phase
    /// angle of about 40°.
    pub fn fixed() -> Self {
        let direction = |polar: f64, longitude: f64| {
            let (polar, longitude) = (polar.to_radians(), longitude.to_radians());
            Vector3::new(polar.sin() * longitude.cos(), polar.sin() * longitude.sin(), polar.cos())
        };
        Self { observer: direction(60.0, 0.0), sun: direction(75.0, 40.0) }
    }

    /// The visible and illuminated projected area of the ellipsoid, in km²:
    /// ½ π abc (√(e·Ce) + e·Cs/√(s·Cs)), C = diag(1/a², 1/b², 1/c²) (S. J. Ostro, R. Connelly,
    /// *Icarus* 57 (1984) 443).
    pub fn brightness(&self, body: &Phase<SO3>, to_frame: &Phase<SO3>) -> f64 {
        let group = SO3::new();
        let attitude = group.compose(&to_frame.group_element, &body.group_element);
        let inverse = group.inverse(&attitude);
        let e = group.coadjoint(&inverse, &self.observer);
        let s = group.coadjoint(&inverse, &self.sun);
        let [a, b, c] = SEMIAXES;
        let form = |u: &Vector3<f64>, v: &Vector3<f64>| {
            u.x * v.x / (a * a) + u.y * v.y / (b * b) + u.z * v.z / (c * c)
        };
        let area = std::f64::consts::PI * a * b * c;
        0.5 * area * (form(&e, &e).sqrt() + form(&e, &s) / form(&s, &s).sqrt())
    }
}

/// A light curve, and the state at its end.
#[derive(Clone, Debug)]
pub struct LightCurve {
    /// Brightness, sampled at equal intervals from t = 0.
    pub samples: Vec<f64>,
    pub interval: f64,
    pub end: Phase<SO3>,
    /// The largest relative drift of the spatial angular momentum.
    pub drift: f64,
    /// The largest relative drift of the Casimir L².
    pub casimir_drift: f64,
}

/// Integrates from the state whose momentum is the closed form's at t = 0; a sample every
/// `stride` steps of `step` days.
pub fn light_curve(
    mode: &LongAxisMode,
    geometry: &Geometry,
    (step, stride): (f64, usize),
    samples: usize,
) -> Result<LightCurve, StepError> {
    let integrator = FreeBody::new(step, INERTIA)?;
    let start = mode.closed_form().momentum(0.0);
    let mut body = Phase::<SO3>::at_identity(start);
    // The rotation about y that takes the angular momentum, in the plane y = 0, to z.
    let tilt = Vector3::new(0.0, -start.x.atan2(start.z), 0.0);
    let to_frame = Phase::<SO3>::new(SO3::new().exp(&tilt), start);
    let mut curve = Vec::with_capacity(samples);
    let (mut drift, mut casimir_drift) = (0.0_f64, 0.0_f64);
    for _ in 0..samples {
        curve.push(geometry.brightness(&body, &to_frame));
        for _ in 0..stride {
            integrator.advance(&mut body)?;
        }
        let spatial = body.spatial_momentum(&SO3::new());
        drift = drift.max((spatial - start).amax() / start.norm());
        let squared = body.momentum.norm_squared();
        casimir_drift = casimir_drift.max((squared / start.norm_squared() - 1.0).abs());
    }
    let interval = step * stride as f64;
    Ok(LightCurve { samples: curve, interval, end: body, drift, casimir_drift })
}

#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// In cycles per day.
    pub frequency: f64,
    /// Relative to the strongest.
    pub amplitude: f64,
}

/// The absolute values of the light curve's Fourier transform, after the mean is taken out and a
/// Hann window put on; entry i is at the frequency i/(samples · interval).
pub fn transform(curve: &LightCurve) -> Vec<f64> {
    use rustfft::num_complex::Complex;
    let n = curve.samples.len();
    let mean = curve.samples.iter().sum::<f64>() / n as f64;
    let mut values: Vec<Complex<f64>> = curve
        .samples
        .iter()
        .enumerate()
        .map(|(i, value)| {
            let window = 0.5 - 0.5 * (TAU * i as f64 / n as f64).cos();
            Complex::new((value - mean) * window, 0.0)
        })
        .collect();
    rustfft::FftPlanner::new().plan_fft_forward(n).process(&mut values);
    values[..n / 2].iter().map(|z| z.norm()).collect()
}

/// The lines of a light curve, strongest first: local maxima of its [`transform`], the frequency
/// refined by a parabola through the logarithms.
pub fn spectrum(curve: &LightCurve, count: usize) -> Vec<Line> {
    let n = curve.samples.len();
    let size = transform(curve);
    let mut lines: Vec<Line> = (2..size.len().saturating_sub(1))
        .filter(|&i| size[i] > size[i - 1] && size[i] >= size[i + 1])
        .map(|i| {
            let [left, peak, right] = [size[i - 1].ln(), size[i].ln(), size[i + 1].ln()];
            let shift = 0.5 * (left - right) / (left - 2.0 * peak + right);
            let frequency = (i as f64 + shift) / (n as f64 * curve.interval);
            Line { frequency, amplitude: size[i] }
        })
        .collect();
    lines.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
    lines.truncate(count);
    let strongest = lines.first().map_or(1.0, |line| line.amplitude);
    lines.iter().map(|line| Line { amplitude: line.amplitude / strongest, ..*line }).collect()
}
