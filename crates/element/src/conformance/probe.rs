//! Leading a law along a path of the kit.

use super::path::Path;
use crate::{Answer, Driver, Kinematics, Link};

/// One step of a march, answered and not yet taken.
pub(super) struct Step<'a> {
    pub(super) time: f64,
    pub(super) at: Kinematics<'a>,
    pub(super) answer: &'a Answer,
    /// The law before the step.
    pub(super) before: &'a Driver<'a>,
}

/// A law at the start of a path.
pub(super) fn start<'a>(link: &'a dyn Link, path: &Path) -> Driver<'a> {
    let (d, v) = path.at(0.0);
    Driver::starting_at(link, &d, &v)
}

/// Leads a law along a path, `steps` a cycle, and shows every step to `look`.
pub(super) fn march<E>(
    link: &dyn Link,
    path: &Path,
    cycles: usize,
    steps: usize,
    mut look: impl FnMut(&Step<'_>) -> Result<(), E>,
) -> Result<(), E> {
    let dt = path.period() / steps as f64;
    let mut driver = start(link, path);
    for (time, d, v) in path.ends(cycles, steps) {
        let at = driver.toward(&d, &v, dt);
        let answer = driver.ask(&at);
        look(&Step { time, at, answer: &answer, before: &driver })?;
        driver.commit(&d, &v, answer);
    }
    Ok(())
}
