use super::*;
use crate::draw;

/// Outcomes at stripes of a structure with θ and β.
fn synthetic(seed: u64, theta: f64, beta: f64, stripes: &[f64], each: usize) -> Vec<(f64, bool)> {
    let u = draw::independent(seed, "test", "capacity", stripes.len() * each);
    let all = stripes.iter().flat_map(|im| std::iter::repeat_n(*im, each));
    let hit = |(im, u): (f64, f64)| (im, u < phi((im / theta).ln() / beta));
    all.zip(u).map(hit).collect()
}

const STRIPES: [f64; 8] = [0.2, 0.3, 0.4, 0.5, 0.7, 0.9, 1.2, 1.6];

#[test]
fn two_stripes_have_a_closed_form() {
    // 3 of 10 at 1, 8 of 10 at 2: the curve passes through both shares.
    let mut runs: Vec<(f64, bool)> = (0..10).map(|i| (1.0, i < 3)).collect();
    runs.extend((0..10).map(|i| (2.0, i < 8)));
    let fit = Fragility::of_outcomes(&runs).unwrap();
    let (z1, z2) = (phi_inverse(0.3), phi_inverse(0.8));
    let beta = 2f64.ln() / (z2 - z1);
    assert!((fit.dispersion - beta).abs() < 1e-9, "{} {beta}", fit.dispersion);
    assert!((fit.median - (-z1 * beta).exp()).abs() < 1e-9, "{}", fit.median);
    // There the variance of the predictor is that of a share: p(1−p)/(n φ²).
    for (im, p) in [(1.0, 0.3), (2.0, 0.8)] {
        let band = fit.at(im, 0.9);
        let z = phi_inverse(p);
        let density = (-0.5 * z * z).exp() / (2.0 * PI).sqrt();
        let deviation = (p * (1.0 - p) / 10.0_f64).sqrt() / density;
        let high = phi(z + phi_inverse(0.95) * deviation);
        assert!((band.probability - p).abs() < 1e-9 && (band.high - high).abs() < 1e-8, "{band:?}");
    }
}

#[test]
fn known_parameters_are_found_within_their_errors() {
    let (theta, beta) = (0.6, 0.4);
    let fit = Fragility::of_outcomes(&synthetic(5, theta, beta, &STRIPES, 2000)).unwrap();
    let [median, dispersion] = fit.standard_errors();
    assert!(((fit.median / theta).ln() / median).abs() < 3.0, "{fit:?}");
    assert!(((fit.dispersion - beta) / dispersion).abs() < 3.0, "{fit:?}");
    assert!(median < 0.01 && dispersion < 0.01);
}

#[test]
fn the_band_covers_the_truth_as_often_as_it_says() {
    let (theta, beta) = (0.6, 0.4);
    let mut inside = [0; 3];
    let trials = 400;
    for seed in 0..trials {
        let fit =
            Fragility::of_outcomes(&synthetic(100 + seed, theta, beta, &STRIPES, 40)).unwrap();
        for (count, im) in inside.iter_mut().zip([0.4, 0.6, 0.9]) {
            let band = fit.at(im, 0.9);
            let truth = phi((im / theta).ln() / beta);
            *count += usize::from(band.low <= truth && truth <= band.high);
        }
    }
    for count in inside {
        let share = count as f64 / trials as f64;
        // Three standard deviations of 400 trials at 0.9.
        assert!((share - 0.9).abs() < 0.045, "{inside:?}");
    }
}

#[test]
fn data_without_a_curve_say_why() {
    let fit = |runs: &[(f64, bool)]| Fragility::of_outcomes(runs).unwrap_err();
    assert_eq!(fit(&[]), FragilityError::Nothing);
    assert_eq!(fit(&[(1.0, false), (2.0, false)]), FragilityError::Never);
    assert_eq!(fit(&[(1.0, true)]), FragilityError::Always);
    assert_eq!(fit(&[(1.0, false), (2.0, true)]), FragilityError::Parted);
    assert_eq!(fit(&[(1.0, true), (2.0, false)]), FragilityError::Falls);
    let falls = [(1.0, true), (1.0, true), (1.0, false), (2.0, false), (2.0, false), (2.0, true)];
    assert_eq!(fit(&falls), FragilityError::Falls);
}

#[test]
fn the_ratio_of_mills_is_smooth_where_the_series_begins() {
    let (a, b) = (mills(12.0), mills(12.0 + 1e-9));
    assert!((a - b).abs() < 1e-7, "{a} {b}");
    assert!((mills(0.0) - (2.0 / PI).sqrt()).abs() < 1e-15);
}

#[test]
fn narrow_intervals_give_the_moments_of_the_logarithms() {
    // Known to a part in a million, capacities are a lognormal sample: mean and standard deviation (divided by
    // n) of its logarithms, with the textbook's errors σ/√n and σ/√(2n).
    let (theta, beta, n) = (0.6f64, 0.4, 300);
    let u = draw::independent(9, "test", "capacity", n);
    let logarithms: Vec<f64> = u.iter().map(|u| theta.ln() + beta * phi_inverse(*u)).collect();
    let mean = logarithms.iter().sum::<f64>() / n as f64;
    let deviation = (logarithms.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / n as f64).sqrt();
    let narrow = |x: &f64| Capacity { low: (x - 1e-4).exp(), high: (x + 1e-4).exp() };
    let fit = Fragility::fit(&logarithms.iter().map(narrow).collect::<Vec<_>>()).unwrap();
    assert!((fit.median.ln() - mean).abs() < 1e-6 && (fit.dispersion - deviation).abs() < 1e-6);
    let [median, dispersion] = fit.standard_errors();
    assert!((median / (deviation / (n as f64).sqrt()) - 1.0).abs() < 1e-4, "{median}");
    assert!((dispersion / (deviation / (2.0 * n as f64).sqrt()) - 1.0).abs() < 1e-4);
}

#[test]
fn copies_of_a_motion_tell_no_more_than_the_motion() {
    // Known to a part in a thousand, 12 capacities three times each: the error of the median is s/√12 with the
    // standard deviation s (divided by n − 1) of their logarithms, and the band that of Student's t with 11.
    let logarithms: Vec<f64> = (0..12).map(|i| 0.3 * ((i * i * 7) % 11) as f64 / 5.0).collect();
    let mean = logarithms.iter().sum::<f64>() / 12.0;
    let deviation = (logarithms.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / 11.0).sqrt();
    let narrow = |x: &f64| Capacity { low: (x - 1e-4).exp(), high: (x + 1e-4).exp() };
    let own = logarithms.iter().enumerate().map(|(i, x)| (narrow(x), i));
    let fit =
        Fragility::fit_motions(&own.clone().chain(own.clone()).chain(own).collect::<Vec<_>>());
    let fit = fit.unwrap();
    assert_eq!((fit.runs, fit.motions), (36, Some(12)));
    let error = deviation / 12f64.sqrt();
    assert!((fit.standard_errors()[0] / error - 1.0).abs() < 1e-4, "{fit:?}");
    // 95 % quantile of Student's t with 11 degrees of freedom from a table.
    let band = fit.at(fit.median, 0.9);
    assert!((band.high - phi(1.795_885 * error / fit.dispersion)).abs() < 1e-4, "{band:?}");
}

#[test]
fn the_band_covers_the_truth_where_motions_have_several_runs() {
    let (theta, beta, motions, trials) = (0.6f64, 0.4, 24, 400u64);
    let (mut inside, mut independent) = (0, 0);
    for seed in 0..trials {
        let u = draw::independent(seed, "test", "motion", motions);
        let v = draw::independent(seed, "test", "member", 5 * motions);
        let one = |(i, v): (usize, &f64)| {
            let x = theta.ln() + beta * phi_inverse(u[i / 5]) + 0.05 * phi_inverse(*v);
            let scale = (x / 0.1).floor() * 0.1;
            (Capacity { low: scale.exp(), high: (scale + 0.1).exp() }, i / 5)
        };
        let all: Vec<_> = v.iter().enumerate().map(one).collect();
        let own: Vec<_> = all.iter().map(|(c, _)| *c).collect();
        let covers = |fit: Fragility| {
            let band = fit.at(0.5, 0.9);
            let truth = phi((0.5f64 / theta).ln() / beta.hypot(0.05));
            usize::from(band.low <= truth && truth <= band.high)
        };
        inside += covers(Fragility::fit_motions(&all).unwrap());
        independent += covers(Fragility::fit(&own).unwrap());
    }
    let share = |n: usize| n as f64 / trials as f64;
    // Three standard deviations of 400 trials at 0.9; runs taken for draws of their own miss it by far.
    assert!((share(inside) - 0.9).abs() < 0.045, "{}", share(inside));
    assert!(share(independent) < 0.7, "{}", share(independent));
}
