//! Trilith's links along a motion.

use super::pair::{KEPT, Ours, Pair};
use super::paths::DURATION;
use trilith::element::Driver;
use trilith::exercise::Specimen;

/// Coordinates of links for those of a motion.
const AXES: [&str; 3] = ["U1", "U2", "U3"];

/// Forces of all links of a pair together, a list for each of the times that are kept.
pub(super) fn forces(pair: &Pair, d: &[Vec<f64>], v: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, String> {
    let mut sum = vec![vec![0.0; d.len()]; KEPT];
    for link in &pair.ours {
        add(link, pair.steps, d, v, &mut sum)?;
    }
    Ok(sum)
}

fn add(
    (kind, set): &Ours,
    steps: usize,
    d: &[Vec<f64>],
    v: &[Vec<f64>],
    sum: &mut [Vec<f64>],
) -> Result<(), String> {
    let set: Vec<_> = set.iter().map(|(n, v)| ((*n).to_owned(), v.clone())).collect();
    let link = Specimen::new(&trilith::registry(), kind, &set).map_err(|e| e.to_string())?;
    // Where each coordinate of the link is among those of the motion.
    let names = link.coordinates();
    let places: Vec<Option<usize>> = names
        .iter()
        .map(|c| AXES.iter().position(|a| *a == c.name).filter(|i| *i < d.len()))
        .collect();
    let at = |all: &[Vec<f64>], i: usize| -> Vec<f64> {
        places.iter().map(|p| p.map_or(0.0, |p| all[p][i])).collect()
    };
    let mut driver = Driver::starting_at(link.law.as_ref(), &at(d, 0), &at(v, 0));
    let (dt, every) = (DURATION / steps as f64, steps / KEPT);
    for i in 1..=steps {
        let f = driver.step(&at(d, i), &at(v, i), dt);
        if i % every == 0 {
            let row = &mut sum[i / every - 1];
            for (place, force) in places.iter().zip(f) {
                if let Some(p) = place {
                    row[*p] += force;
                }
            }
        }
    }
    Ok(())
}
