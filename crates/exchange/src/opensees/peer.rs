//! OpenSees run beside: a Python interpreter that has openseespy runs an exported script, and its files are read back.

use std::fs::{File, read_to_string, write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Environment variable that names the interpreter.
pub const VARIABLE: &str = "TRILITH_OPENSEES";
/// Stem of the script in its folder, and of the files that it writes.
pub const STEM: &str = "model";
/// How often the other process is looked at.
const LOOK: Duration = Duration::from_millis(20);
/// Lines of what the script said that an error shows.
const SHOWN: usize = 12;

/// Where OpenSees runs.
#[derive(Clone, Debug)]
pub struct Peer {
    /// A Python interpreter that has openseespy.
    pub python: PathBuf,
    /// The longest that it may take.
    pub limit: Duration,
}

/// What a run of OpenSees gave.
#[derive(Clone, Debug, Default)]
pub struct PeerRun {
    /// Names of the outputs.
    pub names: Vec<String>,
    /// Times, s.
    pub time: Vec<f64>,
    /// Histories of the outputs, in SI.
    pub histories: Vec<Vec<f64>>,
    /// Of each output: largest value and when, smallest value and when, last value.
    pub peaks: Vec<[f64; 5]>,
    /// Periods after the static cases, links by their tangents, s; longest first.
    pub periods: Vec<f64>,
    /// How long it took, s.
    pub seconds: f64,
}

/// Why there is none.
#[derive(Debug, thiserror::Error)]
pub enum PeerError {
    /// No interpreter, or one without openseespy.
    #[error("no Python interpreter that has openseespy: tried {0}")]
    Missing(String),
    /// The script broke off.
    #[error("OpenSees broke off ({status}); it said\n{said}")]
    Failed {
        /// Exit status.
        status: ExitStatus,
        /// The last lines of its error output.
        said: String,
    },
    /// It took too long and was ended.
    #[error("OpenSees took more than {0:?} and was ended")]
    TooLong(Duration),
    /// It was ended on request.
    #[error("interrupted")]
    Interrupted,
    /// Its files cannot be read.
    #[error("what OpenSees wrote cannot be read: {0}")]
    Unreadable(String),
    /// No folder or no process.
    #[error("OpenSees cannot be run: {0}")]
    Io(#[from] std::io::Error),
}

impl Peer {
    /// The interpreter that is named, by the variable [`VARIABLE`], or `python3` or `python` on the path.
    ///
    /// # Errors
    /// [`PeerError::Missing`] where none of them has openseespy.
    pub fn find(named: Option<&Path>, limit: Duration) -> Result<Self, PeerError> {
        let variable = std::env::var_os(VARIABLE).filter(|v| !v.is_empty()).map(PathBuf::from);
        let candidates = match named.map(Path::to_path_buf).or(variable) {
            Some(one) => vec![one],
            None => vec!["python3".into(), "python".into()],
        };
        let has = |python: &&PathBuf| {
            Command::new(python)
                .args(["-c", "import openseespy.opensees"])
                .stdin(Stdio::null())
                .stdout(Stdio::null())
                .stderr(Stdio::null())
                .status()
                .is_ok_and(|status| status.success())
        };
        match candidates.iter().find(has) {
            Some(python) => Ok(Self { python: python.clone(), limit }),
            None => {
                let tried: Vec<String> =
                    candidates.iter().map(|p| format!("`{}`", p.display())).collect();
                Err(PeerError::Missing(tried.join(", ")))
            }
        }
    }

    /// Runs a script that was exported with the stem [`STEM`], in a folder of its own.
    ///
    /// # Errors
    /// Whatever keeps it from its end, with what it said.
    pub fn run(&self, script: &str, until: Option<&AtomicBool>) -> Result<PeerRun, PeerError> {
        let folder = tempfile::Builder::new().prefix("trilith-opensees-").tempdir()?;
        let started = Instant::now();
        let path = folder.path().join(format!("{STEM}.py"));
        write(&path, script)?;
        let said = folder.path().join("said.txt");
        let child = Command::new(&self.python)
            .arg(&path)
            .current_dir(folder.path())
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(File::create(&said)?)
            .spawn()?;
        let status = self.wait(child, until)?;
        if !status.success() {
            let all = read_to_string(&said).unwrap_or_default();
            let lines: Vec<&str> = all.lines().collect();
            let last = &lines[lines.len().saturating_sub(SHOWN)..];
            return Err(PeerError::Failed { status, said: last.join("\n") });
        }
        let mut run = read(folder.path())?;
        run.seconds = started.elapsed().as_secs_f64();
        Ok(run)
    }

    fn wait(&self, mut child: Child, until: Option<&AtomicBool>) -> Result<ExitStatus, PeerError> {
        let started = Instant::now();
        loop {
            if let Some(status) = child.try_wait()? {
                return Ok(status);
            }
            let stopped = until.is_some_and(|flag| flag.load(Ordering::Relaxed));
            let late = started.elapsed() > self.limit;
            if stopped || late {
                // Without it nothing is left to end.
                let _ = child.kill();
                let _ = child.wait();
                return Err(if stopped {
                    PeerError::Interrupted
                } else {
                    PeerError::TooLong(self.limit)
                });
            }
            std::thread::sleep(LOOK);
        }
    }
}

fn read(folder: &Path) -> Result<PeerRun, PeerError> {
    let text = |name: String| {
        let broken = |e: std::io::Error| PeerError::Unreadable(format!("{name}: {e}"));
        read_to_string(folder.join(&name)).map_err(broken)
    };
    let mut run = PeerRun::default();
    let outputs = text(format!("{STEM}.csv"))?;
    let mut rows = records(&outputs)?.into_iter();
    run.names = rows.next().unwrap_or_default().into_iter().skip(1).collect();
    run.histories = vec![Vec::new(); run.names.len()];
    for row in rows {
        let values = numbers(&row)?;
        if values.len() != run.names.len() + 1 {
            return Err(PeerError::Unreadable(format!(
                "{STEM}.csv: a line of {} numbers",
                values.len()
            )));
        }
        run.time.push(values[0]);
        run.histories.iter_mut().zip(&values[1..]).for_each(|(h, x)| h.push(*x));
    }
    for row in records(&text(format!("{STEM}.peaks.csv"))?)?.into_iter().skip(1) {
        let values = numbers(row.get(1..).unwrap_or_default())?;
        let peak = values.try_into().map_err(|v: Vec<f64>| {
            PeerError::Unreadable(format!("{STEM}.peaks.csv: a line of {} numbers", v.len()))
        })?;
        run.peaks.push(peak);
    }
    if run.peaks.len() != run.names.len() {
        return Err(PeerError::Unreadable(format!("{STEM}.peaks.csv: {} lines", run.peaks.len())));
    }
    for row in records(&text(format!("{STEM}.periods.csv"))?)?.into_iter().skip(1) {
        run.periods.extend(numbers(&row)?.get(1));
    }
    Ok(run)
}

fn numbers(row: &[String]) -> Result<Vec<f64>, PeerError> {
    let number = |cell: &String| cell.parse::<f64>();
    row.iter()
        .map(number)
        .collect::<Result<_, _>>()
        .map_err(|e| PeerError::Unreadable(format!("`{}`: {e}", row.join(","))))
}

/// Records of comma-separated values, of any length.
fn records(text: &str) -> Result<Vec<Vec<String>>, PeerError> {
    let mut reader =
        csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text.as_bytes());
    reader
        .deserialize()
        .collect::<Result<_, csv::Error>>()
        .map_err(|e| PeerError::Unreadable(e.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_have_cells_in_quotes() {
        let all = records("t,\"a, \"\"b\"\"\"\r\n0.0,1e-3\n").unwrap();
        assert_eq!(all, [["t", "a, \"b\""], ["0.0", "1e-3"]]);
    }

    #[test]
    fn an_interpreter_that_is_none_is_missing() {
        let peer = Peer::find(Some(Path::new("no-such-python")), Duration::from_secs(1));
        let said = peer.expect_err("there is none").to_string();
        assert!(said.contains("`no-such-python`"), "{said}");
    }

    #[cfg(unix)]
    #[test]
    fn what_takes_too_long_is_ended_and_what_fails_is_told() {
        // A shell stands for the interpreter: it takes the script as one of its own.
        let peer = |limit| Peer { python: "/bin/sh".into(), limit: Duration::from_millis(limit) };
        let late = peer(100).run("sleep 60", None);
        assert!(matches!(late, Err(PeerError::TooLong(_))), "{late:?}");
        let failed = peer(60_000).run("echo no equilibrium >&2; exit 3", None);
        assert!(
            failed.as_ref().is_err_and(|e| e.to_string().contains("no equilibrium")),
            "{failed:?}"
        );
        let stop = AtomicBool::new(true);
        let stopped = peer(60_000).run("sleep 60", Some(&stop));
        assert!(matches!(stopped, Err(PeerError::Interrupted)), "{stopped:?}");
        let empty = peer(60_000).run("true", None);
        assert!(matches!(empty, Err(PeerError::Unreadable(_))), "{empty:?}");
        let good = "printf 't,x\\n0,1\\n0.5,2\\n' > model.csv; printf 'output,max,t,min,t,final\\nx,2,0.5,1,0,2\\n' > model.peaks.csv; printf 'mode,period\\n1,0.25\\n' > model.periods.csv";
        let run = peer(60_000).run(good, None).expect("a run");
        assert_eq!((run.time, run.periods), (vec![0.0, 0.5], vec![0.25]));
        assert_eq!(
            (run.histories, run.peaks),
            (vec![vec![1.0, 2.0]], vec![[2.0, 0.5, 1.0, 0.0, 2.0]])
        );
    }
}
