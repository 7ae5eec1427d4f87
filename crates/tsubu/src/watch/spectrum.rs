//! Spectra of a host: what its base does, what the structure does, what the base feels.

use super::{Sample, Sheet, Watch};
use crate::about::About;
use crate::view::{View, Wants};
use std::f64::consts::TAU;
use tsubu_frame::State;
use tsubu_frame::state::MissingSection;
use tsubu_scene::plan::{Plan, watch};

pub(super) const ABOUT: About = About {
    key: "watch.NAME.spectrum",
    formula: "\
One-sided power spectral densities by Welch's method: segments of length T that overlap by half, each with a window of Hann, their
squares averaged. Frequencies are the multiples of 1 / T between both ends of `frequency`.
base acceleration density       S_yy: of the acceleration of the base                       [m^2/s^3]
acceleration density            S_zz: of what is told of the structure                      [m^2/s^3]
base force density              S_ff: of the force of structure and grains on the base      [N^2.s]
transmissibility                |S_yz| / S_yy                                               [-]
coherence                       |S_yz|^2 / (S_yy S_zz): 1 where z follows y linearly        [-]
With every segment that ends the table gets these of all segments until then. Numbers in the history, and in the summary as
`... final`: roots of the integrals of the densities over `frequency` (rms), the highest transmissibility and its frequency, and
the number of segments.",
    symbols: "y: base, z: what is told of the structure, both along the host's direction; S_yz: cross density, S = 2 dt |sum w x exp(-i \
2 pi f t)|^2 / sum w^2",
    limits: "A resonance is told where T is longer than about four over its half-power bandwidth 2 zeta f. A density of n segments scatters by \
about 1 / sqrt(n) around its mean, of normal noise; the transmissibility less, where the coherence is near 1. Without a moving base it is not a number. \
Accelerations are 2 pi f times velocities, so that no differences are taken. Looks at every step unless `every` is given: what is \
faster than half of their rate is folded over.",
    reference: "Welch 1967",
};

/// What is summed of a frequency: S_yy, S_zz, S_ff, real and imaginary part of S_yz.
type Sums = [f64; 5];
/// Real and imaginary parts of the transforms of y', z' and f.
type Transforms = [f64; 6];

/// Averages spectra of a host.
#[derive(Clone, Debug)]
pub(super) struct Spectrum {
    host: usize,
    length: f64,
    frequencies: Vec<f64>,
    /// Two that overlap by half; none before the first look.
    segments: Option<[Segment; 2]>,
    sums: Vec<Sums>,
    done: f64,
    /// The numbers that follow from the sums.
    told: [f64; 6],
}

/// A segment that is being gone through.
#[derive(Clone, Debug)]
struct Segment {
    begin: f64,
    /// First and last look in it [s], their number, sum of the squares of the window.
    first: f64,
    last: f64,
    looks: f64,
    window: f64,
    transforms: Vec<Transforms>,
}

impl Segment {
    fn new(begin: f64, frequencies: usize) -> Self {
        Self { begin, first: 0.0, last: 0.0, looks: 0.0, window: 0.0, transforms: vec![[0.0; 6]; frequencies] }
    }

    /// Numbers before the transforms in a checkpoint.
    const HEAD: usize = 5;

    fn numbers(&self) -> impl Iterator<Item = f64> {
        let head = [self.begin, self.first, self.last, self.looks, self.window];
        head.into_iter().chain(self.transforms.iter().flatten().copied())
    }

    fn from_numbers(numbers: &[f64]) -> Option<Self> {
        let (&[begin, first, last, looks, window], rest) = numbers.split_first_chunk::<{ Self::HEAD }>()?;
        Some(Self { begin, first, last, looks, window, transforms: rest.as_chunks::<6>().0.to_vec() })
    }

    /// Adds a look; phases are (cosine, sine) of every frequency.
    fn take(&mut self, time: f64, length: f64, values: [f64; 3], phases: &[[f64; 2]]) {
        if time < self.begin {
            return;
        }
        if self.looks == 0.0 {
            self.first = time;
        }
        (self.last, self.looks) = (time, self.looks + 1.0);
        let w = 0.5 - 0.5 * (TAU * (time - self.begin) / length).cos();
        self.window += w * w;
        let [y, z, f] = values.map(|x| w * x);
        for (sums, [cos, sin]) in self.transforms.iter_mut().zip(phases) {
            *sums = [
                sums[0] + y * cos,
                sums[1] - y * sin,
                sums[2] + z * cos,
                sums[3] - z * sin,
                sums[4] + f * cos,
                sums[5] - f * sin,
            ];
        }
    }

    /// Adds what it has to the sums, and whether it had anything.
    fn close(&self, frequencies: &[f64], sums: &mut [Sums]) -> bool {
        if self.looks < 2.0 {
            return false;
        }
        let scale = 2.0 * (self.last - self.first) / (self.looks - 1.0) / self.window;
        for ((sums, f), [yr, yi, zr, zi, fr, fi]) in sums.iter_mut().zip(frequencies).zip(&self.transforms) {
            let squared = scale * (TAU * f).powi(2);
            let add = [
                squared * (yr * yr + yi * yi),
                squared * (zr * zr + zi * zi),
                scale * (fr * fr + fi * fi),
                squared * (yr * zr + yi * zi),
                squared * (yr * zi - yi * zr),
            ];
            sums.iter_mut().zip(add).for_each(|(sum, add)| *sum += add);
        }
        true
    }
}

pub(super) fn open(asked: &watch::Spectrum, plan: &Plan) -> Spectrum {
    let watch::Spectrum { host, frequency: [low, high], segment } = asked;
    let lines = (low * segment - 1e-9).ceil() as u32..=(high * segment + 1e-9).floor() as u32;
    let frequencies: Vec<f64> = lines.map(|line| f64::from(line) / segment).collect();
    Spectrum {
        host: plan.hosts.keys().position(|name| name == host).unwrap_or(0),
        length: *segment,
        sums: vec![[0.0; 5]; frequencies.len()],
        frequencies,
        segments: None,
        done: 0.0,
        told: [f64::NAN; 6],
    }
}

impl Spectrum {
    /// Densities, transmissibility and coherence of a frequency.
    fn values(&self, [yy, zz, ff, re, im]: Sums) -> [f64; 5] {
        let cross = re.hypot(im);
        let ratio = |a: f64, b: f64| if b > 0.0 { a / b } else { f64::NAN };
        [yy / self.done, zz / self.done, ff / self.done, ratio(cross, yy), ratio(cross * cross, yy * zz)]
    }

    fn tell(&mut self) {
        let rms = |k: usize| (self.sums.iter().map(|sums| sums[k]).sum::<f64>() / self.done / self.length).sqrt();
        let all = self.sums.iter().zip(&self.frequencies).map(|(sums, f)| (self.values(*sums)[3], *f));
        let top = all.filter(|(gain, _)| gain.is_finite()).max_by(|a, b| a.0.total_cmp(&b.0));
        let (highest, at) = top.unwrap_or((f64::NAN, f64::NAN));
        self.told = [rms(0), rms(1), rms(2), highest, at, self.done];
    }
}

impl Watch for Spectrum {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn wants(&self) -> Wants {
        Wants::GRAINS
    }

    fn scalars(&self) -> Vec<String> {
        [
            "base rms acceleration [m/s^2]",
            "rms acceleration [m/s^2]",
            "rms base force [N]",
            "highest transmissibility [-]",
            "frequency of highest transmissibility [Hz]",
            "segments [-]",
        ]
        .map(str::to_owned)
        .to_vec()
    }

    fn so_far(&self) -> &'static [&'static str] {
        &[""]
    }

    fn sheet(&self) -> Option<Sheet> {
        let values = [
            "base acceleration density [m^2/s^3]",
            "acceleration density [m^2/s^3]",
            "base force density [N^2.s]",
            "transmissibility [-]",
            "coherence [-]",
        ];
        Some(Sheet {
            coordinates: vec!["frequency [Hz]".to_owned()],
            values: values.map(str::to_owned).to_vec(),
            steady: false,
        })
    }

    fn take(&mut self, view: &View) -> Sample {
        let Some(host) = view.hosts.get(self.host) else {
            return Sample { scalars: vec![f64::NAN; 6], rows: Vec::new() };
        };
        let (time, count) = (view.time, self.frequencies.len());
        let begun = || [0.0, 0.5].map(|part| Segment::new(time + part * self.length, count));
        let mut segments = self.segments.take().unwrap_or_else(begun);
        let mut ended = false;
        for segment in &mut segments {
            while time - segment.begin > self.length * (1.0 - 1e-9) {
                if segment.close(&self.frequencies, &mut self.sums) {
                    self.done += 1.0;
                    ended = true;
                }
                *segment = Segment::new(segment.begin + self.length, count);
            }
        }
        let phase = |f: &f64| {
            let (sin, cos) = (TAU * f * time).sin_cos();
            [cos, sin]
        };
        let phases: Vec<[f64; 2]> = self.frequencies.iter().map(phase).collect();
        let values = [host.base_at(time)[1], host.velocity(), host.base_force(time)];
        for segment in &mut segments {
            segment.take(time, self.length, values, &phases);
        }
        self.segments = Some(segments);
        let row = |(f, sums): (&f64, &Sums)| [&[*f], self.values(*sums).as_slice()].concat();
        let rows = if ended { self.frequencies.iter().zip(&self.sums).map(row).collect() } else { Vec::new() };
        if ended {
            self.tell();
        }
        Sample { scalars: self.told.to_vec(), rows }
    }

    fn remark(&self, _last: bool) -> Option<String> {
        let short = self.done == 0.0;
        short.then(|| format!("no segment of {} s has ended: `segment` is longer than what was looked at", self.length))
    }

    fn save(&self, name: &str, state: &mut State) {
        let segments = self.segments.iter().flatten().flat_map(Segment::numbers);
        state.put_real(&format!("{name}.segments"), segments.collect::<Vec<f64>>());
        let sums = [self.done].into_iter().chain(self.sums.iter().flatten().copied());
        state.put_real(&format!("{name}.sums"), sums.collect::<Vec<f64>>());
    }

    fn load(&mut self, name: &str, state: &State) -> Result<(), MissingSection> {
        let count = self.frequencies.len();
        let section = |what: &str| (format!("{name}.{what}"), state.real(&format!("{name}.{what}")));
        let (segments, numbers) = section("segments");
        let numbers = numbers?;
        let one = Segment::HEAD + 6 * count;
        self.segments = match numbers.len() {
            0 => None,
            n if n == 2 * one => Segment::from_numbers(&numbers[..one])
                .zip(Segment::from_numbers(&numbers[one..]))
                .map(|(first, second)| [first, second]),
            _ => return Err(MissingSection { name: segments, kind: "real" }),
        };
        let (sums, numbers) = section("sums");
        match numbers? {
            [done, rest @ ..] if rest.len() == 5 * count => {
                (self.done, self.sums) = (*done, rest.as_chunks::<5>().0.to_vec());
                if self.done > 0.0 {
                    self.tell();
                }
            }
            _ => return Err(MissingSection { name: sums, kind: "real" }),
        }
        Ok(())
    }
}
