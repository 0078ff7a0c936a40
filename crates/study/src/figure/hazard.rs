//! Demand exceeded against intensity and, where the hazard is known, how often in a year.

use crate::{Row, Spread, Study};
use trilith::report::{Color, Figure, Stroke};

/// Curves of single intensities.
const CURVES: usize = 6;

/// Demands of the runs at an intensity, sorted; ∞ for a body that overturned.
struct Stripe {
    intensity: f64,
    demands: Vec<f64>,
}

impl Stripe {
    fn exceeds(&self, demand: f64) -> f64 {
        let below = self.demands.partition_point(|d| *d <= demand);
        1.0 - below as f64 / self.demands.len() as f64
    }
}

fn stripes(study: &Study, runs: &[Row<'_>], demand: &str, intensity: &str) -> Vec<Stripe> {
    let number = |r: Row<'_>, name| r.number(&study.varied, &study.columns, name);
    let one = |r: Row<'_>| {
        let x = if r.overturned() { f64::INFINITY } else { number(r, demand)? };
        Some((number(r, intensity)?, x))
    };
    let mut all: Vec<(f64, f64)> =
        runs.iter().copied().filter(|r| r.good()).filter_map(one).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let same = |a: &(f64, f64), b: &(f64, f64)| (a.0 - b.0).abs() <= 1e-9 * a.0.abs();
    let stripe = |part: &[(f64, f64)]| Stripe {
        intensity: part[0].0,
        demands: part.iter().map(|p| p.1).collect(),
    };
    all.chunk_by(same).map(stripe).collect()
}

pub(super) fn draw(
    study: &Study,
    runs: &[Row<'_>],
    (demand, intensity): (&str, &str),
    rates: &[(f64, f64)],
) -> Vec<Figure> {
    let all = stripes(study, runs, demand, intensity);
    let largest = all.iter().flat_map(|s| &s.demands).filter(|d| d.is_finite());
    let right = largest.fold(0.0f64, |a, d| a.max(*d));
    let number = |r: Row<'_>, name| r.number(&study.varied, &study.columns, name);
    let one = |(row, r): (usize, Row<'_>)| {
        Some((
            (number(r, intensity)?, number(r, demand).filter(|_| r.good() && !r.overturned())?),
            row,
        ))
    };
    let (points, rows): (Vec<_>, Vec<_>) = runs.iter().copied().enumerate().filter_map(one).unzip();
    let mut over =
        Figure::new("Demand over intensity", study.label(intensity), study.label(demand))
            .colored("runs", Stroke::Rings, Color::CONTEXT, points)
            .standing_for(rows);
    for (name, of) in [
        ("median", (|s: &Spread| s.median) as fn(&Spread) -> f64),
        ("16 %", |s| s.low),
        ("84 %", |s| s.high),
    ] {
        let points = all.iter().filter_map(|s| Some((s.intensity, of(&Spread::of(&s.demands)?))));
        over = over.line(name, points.filter(|p| p.1.is_finite()));
    }
    let demands: Vec<f64> = (1..=200).map(|i| right * f64::from(i) / 200.0).collect();
    let axis = format!("probability that {} is exceeded", demand.replace('_', " "));
    let mut share = Figure::new("Exceedance at single intensities", study.label(demand), axis);
    let every = all.len().div_ceil(CURVES).max(1);
    for s in all.iter().skip((all.len().max(1) - 1) % every).step_by(every) {
        let unit = study.unit(intensity);
        let name = format!("{} = {:.4} {unit}", intensity.replace('_', " "), s.intensity);
        share = share.line(name.trim_end().to_owned(), demands.iter().map(|d| (*d, s.exceeds(*d))));
    }
    let mut figures = vec![over, share.ranges((0.0, right), (0.0, 1.0))];
    if !rates.is_empty() && !all.is_empty() {
        let annual = demands.iter().map(|d| (*d, rate(&all, rates, *d))).filter(|p| p.1 > 0.0);
        figures.push(
            Figure::new("Hazard", study.label(demand), "annual rate of exceedance [1/year]")
                .line("computed", annual)
                .log_y()
                .caption(
                    "Sum over the intensities of the share of runs that exceed the demand times the annual rate \
                     of motions about that intensity; the strongest stands for everything above it, and nothing \
                     weaker than the weakest counts.",
                ),
        );
    }
    figures
}

/// ∑ P(D > d | im) ΔH with the borders between intensities at their geometric means.
fn rate(all: &[Stripe], rates: &[(f64, f64)], demand: f64) -> f64 {
    let border = |i: usize| (all[i].intensity * all[i + 1].intensity).sqrt();
    let mut sum = 0.0;
    for (i, stripe) in all.iter().enumerate() {
        let low = if i == 0 { stripe.intensity } else { border(i - 1) };
        let high = if i + 1 < all.len() { hazard(rates, border(i)) } else { 0.0 };
        sum += stripe.exceeds(demand) * (hazard(rates, low) - high).max(0.0);
    }
    sum
}

/// The hazard curve, straight in logarithms, its ends continued.
fn hazard(rates: &[(f64, f64)], intensity: f64) -> f64 {
    let i = rates.partition_point(|r| r.0 < intensity).clamp(1, rates.len() - 1);
    let ((x0, y0), (x1, y1)) = (rates[i - 1], rates[i]);
    let slope = (y1 / y0).ln() / (x1 / x0).ln();
    y0 * (intensity / x0).powf(slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_hazard_and_a_power_law_demand_have_a_closed_form() {
        // H = k₀ im^−k, D = c im without scatter: λ(d) = k₀ (d/c)^−k.
        let (k0, k, c) = (1e-4f64, 2.5f64, 0.3f64);
        let rates = [(0.1, k0 * 0.1f64.powf(-k)), (2.0, k0 * 2f64.powf(-k))];
        let im = |i: i32| 0.05 * 1.02f64.powi(i);
        let all: Vec<Stripe> =
            (0..200).map(|i| Stripe { intensity: im(i), demands: vec![c * im(i)] }).collect();
        for d in [0.05, 0.1, 0.3] {
            let exact = k0 * (d / c).powf(-k);
            let found = rate(&all, &rates, d);
            assert!((found / exact - 1.0).abs() < 0.03, "{d}: {found} {exact}");
        }
    }
}
