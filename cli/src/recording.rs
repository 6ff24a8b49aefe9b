//! Files of a run for other tools, by the options of `cotama run` and `cotama replay`.

use crate::args::RecordingArgs;
use crate::exit::Failure;
use crate::output;
use cotama_recording::NoRecording;
use cotama_sim::options::Fidelity;
use cotama_sim::trace::Trace;
use std::path::{Path, PathBuf};

/// Refuses places where nothing can be written, before the work begins.
pub(crate) fn places(args: &RecordingArgs) -> Result<(), Failure> {
    let tum = args.tum.as_deref().map(poses);
    let all = args.mcap.iter().chain(&args.csv).chain(&args.indicators).chain(tum.iter().flatten());
    all.into_iter().try_for_each(|it| output::place(it))
}

/// Refuses files of poses for a run on a line; `remedy` says what makes one in the plane.
pub(crate) fn needs_plane(
    args: &RecordingArgs,
    fidelity: Fidelity,
    remedy: &str,
) -> Result<(), Failure> {
    match args.first_of_plane().filter(|_| fidelity.is_line()) {
        None => Ok(()),
        Some(option) => {
            let message = format!("{option} needs poses, and a robot on a line has none");
            Err(Failure::new(message).help(remedy))
        }
    }
}

/// Refuses files for other tools of a team's run.
pub(crate) fn no_team(args: &RecordingArgs) -> Result<(), Failure> {
    match args.first() {
        None => Ok(()),
        Some(option) => Err(Failure::new(format!("{option} is for missions, and this is a team"))),
    }
}

/// Writes the files that are wanted, and returns their paths.
pub(crate) fn write(args: &RecordingArgs, trace: &Trace) -> Result<Vec<String>, Failure> {
    let refused = |it: NoRecording| Failure::new(it.to_string());
    let mut written = Vec::new();
    let mut put = |path: &Path, bytes: &[u8]| {
        output::file(path, bytes)?;
        written.push(path.display().to_string());
        Ok::<_, Failure>(())
    };
    if let Some(path) = &args.mcap {
        put(path, &cotama_recording::mcap(trace).map_err(refused)?)?;
    }
    if let Some(path) = &args.csv {
        put(path, cotama_recording::csv(trace).as_bytes())?;
    }
    if let Some(path) = &args.indicators {
        put(path, cotama_recording::indicators(trace).map_err(refused)?.as_bytes())?;
    }
    if let Some(name) = &args.tum {
        let files = cotama_recording::tum(trace).map_err(refused)?;
        for (path, text) in poses(name).iter().zip([files.truth, files.odometry]) {
            put(path, text.as_bytes())?;
        }
    }
    Ok(written)
}

/// Returns the files of poses of a name: of true ones, and of those of odometry.
fn poses(name: &Path) -> [PathBuf; 2] {
    ["truth", "odometry"].map(|kind| {
        let mut path = name.as_os_str().to_owned();
        path.push(format!(".{kind}.tum"));
        path.into()
    })
}
