//! Maps of ROS, read as Nav2 reads them.
//!
//! The rules are those of `nav2_map_server/src/map_io.cpp` of Nav2 (branch main of 2025, where
//! images are compared as matrices), and of the libraries that it uses: yaml-cpp 0.8 for the text,
//! `GraphicsMagick` 1.3 with 16 bits a channel for the image.
//!
//! *The text.* A YAML mapping; of several documents the first, of a key that is there twice the
//! first. `image`, `resolution`, `origin`, `free_thresh`, `occupied_thresh` and `negate` are
//! required, `mode` is not; other keys are not read.
//!
//! - `image`: not empty; relative to the folder of the text unless it begins with `/`.
//! - `resolution`, the thresholds: decimal numbers, quoted or not.
//! - `origin`: three of them, x and y in metres and the yaw in radians.
//! - `negate`: a whole number (not 0 is true), else `yes`, `true`, `on`, `y`, or one of their
//!   opposites, in small letters, in capitals, or with one capital first.
//! - `mode`: `trinary`, which is the default, `scale` or `raw`, in letters of any size.
//!
//! *The image.* Each pixel becomes a grey `g` of 0 to 255: of a colour 0.299 red, 0.587 green and
//! 0.114 blue, of finer channels the whole part after a division by 257. With `n = g / 255` if
//! `negate` is true and else `1 - g / 255`, both in single precision like the thresholds, the value
//! of a cell is
//!
//! - `trinary`: 0 if `n <= free_thresh`, else 100 if `n >= occupied_thresh`, else -1: free wins;
//! - `scale`: the same, but between the thresholds
//!   `round((n - free_thresh) / (occupied_thresh - free_thresh) * 100)`;
//! - `raw`: `g` if it is at most 100, else -1, whatever `negate` and the thresholds say.
//!
//! In `trinary` and `scale` a pixel that is not fully opaque is -1. The first row of the image is
//! the highest one of the map.
//!
//! Stricter than Nav2, which would take them and come to grief: cells of less than 1 mm or more
//! than 10 m, numbers that are not finite, origins further than 1,000 km away, texts of more than
//! [`MAX_TEXT`] bytes, images of more than [`MAX_CELLS`](crate::MAX_CELLS) cells. A yaw other than
//! 0 is a [`Warning`]: like most of Nav2, this crate does not turn maps. Images are PNG, or PGM in
//! letters (`P2`) or bytes (`P5`).
//!
//! ```
//! use cotama_floor::map_server::{Map, Metadata};
//! let text = "image: a.pgm\nresolution: 0.05\norigin: [-1.0, 0, 0]\nnegate: 0\n\
//!             occupied_thresh: 0.65\nfree_thresh: 0.196\n";
//! let (metadata, warnings) = Metadata::parse("a.yaml", text).unwrap();
//! assert!(warnings.is_empty());
//! let map = Map::read(&metadata, "a.pgm", b"P2 3 2 255  0 205 254  254 254 254").unwrap();
//! assert_eq!(map.values(), [0, 0, 0, 100, -1, 0]);
//! assert_eq!(map.grid().unwrap().resolution(), 0.05);
//! let wrong = Metadata::parse("a.yaml", &text.replace("free_thresh", "free_tresh")).unwrap_err();
//! assert!(wrong.to_string().starts_with("a.yaml:6:1: unknown key `free_tresh`; did you mean"));
//! ```

mod image;
mod kinds;
mod metadata;
mod pgm;
mod png;
mod values;

pub use image::ImageError;
pub use metadata::{MAX_TEXT, Metadata, Mode, Warning};
pub use values::Map;
