//! The files of a run for other tools.

use clap::Args;
use std::path::PathBuf;

#[derive(Args, Clone, Debug)]
pub(crate) struct RecordingArgs {
    /// Writes a run in the plane for Foxglove, Lichtblick and PlotJuggler: map, poses, scans,
    /// margins, supervisors
    #[arg(long, value_name = "FILE.mcap")]
    pub(crate) mcap: Option<PathBuf>,
    /// Writes the samples of the run as comma-separated values
    #[arg(long, value_name = "FILE.csv")]
    pub(crate) csv: Option<PathBuf>,
    /// Writes the poses of a run in the plane for evo: NAME.truth.tum, NAME.odometry.tum
    #[arg(long, value_name = "NAME")]
    pub(crate) tum: Option<PathBuf>,
    /// Writes ten indicators of a run in the plane at each of its samples, as CSV with the columns
    /// of `cotama risk observe`; `--monitor-period 500` of `cotama run` takes two samples a second
    #[arg(long, value_name = "FILE.csv")]
    pub(crate) indicators: Option<PathBuf>,
}

impl RecordingArgs {
    /// The first of these options that was given.
    pub(crate) fn first(&self) -> Option<&'static str> {
        self.first_of_plane().or(self.csv.as_ref().map(|_| "--csv"))
    }

    /// The first of those that need poses.
    pub(crate) fn first_of_plane(&self) -> Option<&'static str> {
        let mcap = self.mcap.as_ref().map(|_| "--mcap");
        let indicators = self.indicators.as_ref().map(|_| "--indicators");
        mcap.or(self.tum.as_ref().map(|_| "--tum")).or(indicators)
    }
}
