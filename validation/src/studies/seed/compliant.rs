//! Figure 1 once more, as the paper ran it: a 5 Hz sine, on the contacts of the shipped model.

use super::chart::{Chart, Contact, Motion, POINTS, mode, picture, point, shenton};
use crate::case::{Kind, Tolerance};
use crate::{Findings, Study};
use trilith::SolverKind;

pub(super) fn studies() -> Vec<Study> {
    vec![Study {
        id: "FIG-1f",
        title: "Initiation chart, H/B = 2, 5 Hz sine, contacts of the shipped model",
        source: "the two solvers against each other; borders: Shenton 1996, J. Eng. Mech. 122(7), 690–693",
        work,
    }]
}

fn work(f: &mut Findings) -> Result<(), String> {
    let fna = Chart {
        slender: 2.0,
        motion: Motion::Sine,
        contact: Contact::Shipped,
        solver: SolverKind::Fna,
    };
    let (mut by_fna, mut by_hht) = ([[0; POINTS]; POINTS], [[0; POINTS]; POINTS]);
    let mut found = [const { Vec::new() }; 4];
    let mut differ = Vec::new();
    for i in 0..POINTS {
        for j in 0..POINTS {
            let (mu, a) = point(i, j);
            by_fna[i][j] = mode(fna, a, mu)?;
            by_hht[i][j] = mode(Chart { solver: SolverKind::Hht, ..fna }, a, mu)?;
            found[by_fna[i][j]].push((mu, a));
            if by_fna[i][j] != shenton(a, mu, 2.0) {
                differ.push((mu, a));
            }
        }
    }
    // A point is judged where all points around it have its mode: off the borders of this block.
    let (mut judged, mut apart) = (0, 0);
    for i in 1..POINTS - 1 {
        for j in 1..POINTS - 1 {
            let mut around = by_fna[i - 1..=i + 1].iter().flat_map(|row| &row[j - 1..=j + 1]);
            if around.all(|m| *m == by_fna[i][j]) {
                judged += 1;
                apart += usize::from(by_hht[i][j] != by_fna[i][j]);
            }
        }
    }
    let all = POINTS * POINTS;
    let both =
        (0..all).filter(|k| by_fna[k / POINTS][k % POINTS] == by_hht[k / POINTS][k % POINTS]);
    f.text(format!(
        "Contacts that give 0.1 mm ring when the block begins to slide, and the ringing lifts a foot \
         that would stay down on rigid ground, the more the faster the acceleration grows: {} of {all} \
         points are in another mode than the closed form's. On contacts 400 times as stiff, damped \
         against ringing, the borders are those of the closed form (FIG-1d). FNA and direct \
         integration agree at {} points. Repeat a run near a border with stiffer contacts before \
         believing its mode.",
        differ.len(),
        both.count(),
    ));
    f.figure(picture(fna, &found, differ));
    f.check(
        format!("points in another mode under HHT, of {judged} off the borders"),
        "",
        (0.0, Kind::Theory),
        Tolerance::Absolute(0.0),
        "FNA − HHT",
        apart as f64,
    );
    Ok(())
}
