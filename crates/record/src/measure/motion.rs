//! Velocity and displacement of an acceleration that is straight between samples.

/// Largest |value|.
#[must_use]
pub fn peak(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |a, x| a.max(x.abs()))
}

/// Velocity at the samples, from rest, m/s: v₁ = v₀ + (a₀ + a₁) Δt/2.
#[must_use]
pub fn velocity(acceleration: &[f64], dt: f64) -> Vec<f64> {
    let mut v = 0.0;
    let mut all = Vec::with_capacity(acceleration.len());
    all.extend(acceleration.first().map(|_| 0.0));
    for w in acceleration.windows(2) {
        v += 0.5 * dt * (w[0] + w[1]);
        all.push(v);
    }
    all
}

/// Displacement at the samples, from rest at zero, m: u₁ = u₀ + v₀ Δt + (2a₀ + a₁) Δt²/6.
#[must_use]
pub fn displacement(acceleration: &[f64], dt: f64) -> Vec<f64> {
    let (mut u, mut v) = (0.0, 0.0);
    let mut all = Vec::with_capacity(acceleration.len());
    all.extend(acceleration.first().map(|_| 0.0));
    for w in acceleration.windows(2) {
        u += v * dt + dt * dt * (2.0 * w[0] + w[1]) / 6.0;
        v += 0.5 * dt * (w[0] + w[1]);
        all.push(u);
    }
    all
}
