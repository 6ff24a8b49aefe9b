//! Maps of ROS: images of every kind as the rules say, broken ones refused with their place, and
//! mutants of both.
#![allow(clippy::unwrap_used, clippy::cast_precision_loss)]

use crate::common;
use cotama_floor::map_server::{Map, Metadata, Mode};
use cotama_fuzz::{Random, mutant};
use png::{BitDepth, ColorType};

const TEXT: &str = "image: a.pgm\nmode: trinary\nresolution: 0.05\norigin: [-1.0, -2.5, 0.0]\n\
                    negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";

/// Width and height of the images.
const SIZE: [usize; 2] = [16, 4];

fn metadata(mode: &str, negate: bool) -> Metadata {
    let text = TEXT.replace("trinary", mode).replace("negate: 0", &format!("negate: {negate}"));
    Metadata::parse("a.yaml", &text).unwrap().0
}

/// An image: its bytes, and the grey and the opacity of each pixel from the top, of 8 bits.
struct Case {
    name: String,
    bytes: Vec<u8>,
    pixels: Vec<(u8, u8)>,
}

fn png(color: ColorType, depth: BitDepth, extra: &[(&str, &[u8])], data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, SIZE[0] as u32, SIZE[1] as u32);
    encoder.set_color(color);
    encoder.set_depth(depth);
    for (key, value) in extra {
        match *key {
            "palette" => encoder.set_palette(value.to_vec()),
            _ => encoder.set_trns(value.to_vec()),
        }
    }
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(data).unwrap();
    writer.finish().unwrap();
    bytes
}

/// Packs samples of few bits.
fn packed(samples: &[u8], bits: usize) -> Vec<u8> {
    let each = 8 / bits;
    let whole = |it: &[u8]| it.iter().fold(0, |all, it| all << bits | u16::from(*it)) as u8;
    samples.chunks(each).map(whole).collect()
}

fn grey(red: u16, green: u16, blue: u16) -> u8 {
    // The grey of GraphicsMagick with 16 bits a channel, as a fraction without loss.
    let sum = 299 * u64::from(red) + 587 * u64::from(green) + 114 * u64::from(blue);
    ((2 * sum + 1_000) / 2_000 / 257) as u8
}

/// Images of every kind with drawn pixels.
fn cases() -> Vec<Case> {
    let mut random = Random(2);
    let count = SIZE[0] * SIZE[1];
    let mut all = Vec::new();
    let mut add = |name: String, bytes: Vec<u8>, pixels: Vec<(u8, u8)>| {
        assert_eq!(pixels.len(), count, "{name}");
        all.push(Case { name, bytes, pixels });
    };
    for most in [1_usize, 7, 100, 255, 256, 1_000, 65_535] {
        let samples: Vec<usize> = (0..count).map(|_| random.below(most + 1)).collect();
        let pixels: Vec<_> = samples.iter().map(|it| ((it * 255 / most) as u8, 255)).collect();
        let head = format!("{} {}\n# most\n{most}", SIZE[0], SIZE[1]);
        let letters: Vec<_> = samples.iter().map(ToString::to_string).collect();
        let text = format!("P2 # a comment\n{head}\n{}\n", letters.join(" "));
        add(format!("P2, greys to {most}"), text.into_bytes(), pixels.clone());
        let mut bytes = format!("P5\n{head}\n").into_bytes();
        for it in samples {
            let [high, low] = (it as u16).to_be_bytes();
            bytes.extend(if most > 255 { vec![high, low] } else { vec![low] });
        }
        add(format!("P5, greys to {most}"), bytes, pixels);
    }
    for (bits, depth) in
        [(1, BitDepth::One), (2, BitDepth::Two), (4, BitDepth::Four), (8, BitDepth::Eight)]
    {
        let most = (1_usize << bits) - 1;
        let samples: Vec<u8> = (0..count).map(|_| random.below(most + 1) as u8).collect();
        let spread = |it: &u8| ((*it as usize * 255 / most) as u8, 255);
        let data = packed(&samples, bits);
        let bytes = png(ColorType::Grayscale, depth, &[], &data);
        add(format!("PNG, grey of {bits} bits"), bytes, samples.iter().map(spread).collect());
        // One grey is transparent.
        let hidden = samples[0];
        let pixels = samples.iter().map(|it| (spread(it).0, if *it == hidden { 0 } else { 255 }));
        let bytes = png(ColorType::Grayscale, depth, &[("trns", &[0, hidden])], &data);
        add(format!("PNG, grey of {bits} bits, one transparent"), bytes, pixels.collect());
        let palette: Vec<u8> = (0..=most * 3 + 2).map(|_| random.below(256) as u8).collect();
        let palette = &palette[..(most + 1) * 3];
        let opacities: Vec<u8> = (0..=most).map(|it| if it % 3 == 0 { 200 } else { 255 }).collect();
        let color = |it: &u8| {
            let at = 3 * *it as usize;
            let [red, green, blue] = [0, 1, 2].map(|it| u16::from(palette[at + it]) * 257);
            grey(red, green, blue)
        };
        let pixels = samples.iter().map(|it| (color(it), 255)).collect();
        let bytes = png(ColorType::Indexed, depth, &[("palette", palette)], &data);
        add(format!("PNG, palette of {bits} bits"), bytes, pixels);
        let pixels = samples.iter().map(|it| (color(it), opacities[*it as usize])).collect();
        let extra: [(&str, &[u8]); 2] = [("palette", palette), ("trns", &opacities)];
        let bytes = png(ColorType::Indexed, depth, &extra, &data);
        add(format!("PNG, palette of {bits} bits, some transparent"), bytes, pixels);
    }
    for (color, samples) in [
        (ColorType::Grayscale, 1),
        (ColorType::GrayscaleAlpha, 2),
        (ColorType::Rgb, 3),
        (ColorType::Rgba, 4),
    ] {
        for (depth, scale) in [(BitDepth::Eight, 257), (BitDepth::Sixteen, 1)] {
            let mut data = Vec::new();
            let mut pixels = Vec::new();
            for _ in 0..count {
                let mut channels: Vec<u16> =
                    (0..samples).map(|_| random.below(65_536 / scale) as u16).collect();
                if samples % 2 == 0 && random.below(2) == 0 {
                    channels[samples - 1] = (65_535 / scale) as u16;
                }
                for it in &channels {
                    let [high, low] = it.to_be_bytes();
                    data.extend(if scale == 1 { vec![high, low] } else { vec![low] });
                }
                let wide: Vec<u16> = channels.iter().map(|it| it * scale as u16).collect();
                let tone = if samples < 3 { wide[0] } else { 0 };
                let shade = match samples {
                    1 | 2 => (tone / 257) as u8,
                    _ => grey(wide[0], wide[1], wide[2]),
                };
                let opacity = if samples % 2 == 0 { wide[samples - 1] / 257 } else { 255 };
                pixels.push((shade, opacity as u8));
            }
            add(format!("PNG, {color:?} of {depth:?}"), png(color, depth, &[], &data), pixels);
        }
    }
    all
}

/// The value of a cell, said again as the rules of the module say it.
fn value(mode: Mode, negate: bool, grey: u8, opacity: u8) -> i8 {
    if mode == Mode::Raw {
        return i8::try_from(grey).ok().filter(|it| *it <= 100).unwrap_or(-1);
    }
    if opacity < 255 {
        return -1;
    }
    let n = if negate { f32::from(grey) / 255.0 } else { 1.0 - f32::from(grey) / 255.0 };
    let is_free = n <= 0.196;
    let is_occupied = n >= 0.65;
    match (mode, is_free, is_occupied) {
        (_, true, _) => 0,
        (_, _, true) => 100,
        (Mode::Scale, ..) => ((n - 0.196) / (0.65_f64 - 0.196) as f32 * 100.0).round() as i8,
        _ => -1,
    }
}

#[test]
fn images_of_every_kind_are_read_by_the_rules() {
    let cases = cases();
    assert!(cases.len() >= 38, "{}", cases.len());
    let mut seen = [0; 3];
    for (at, Case { name, bytes, pixels }) in cases.iter().enumerate() {
        for (mode, word) in [(Mode::Trinary, "trinary"), (Mode::Scale, "SCALE"), (Mode::Raw, "raw")]
        {
            for negate in [at % 2 == 0, at % 2 == 1] {
                let map = Map::read(&metadata(word, negate), name, bytes).unwrap();
                let rows = pixels.chunks(SIZE[0]).rev().flatten();
                let wanted: Vec<_> = rows.map(|it| value(mode, negate, it.0, it.1)).collect();
                assert_eq!(map.values(), wanted, "{name}, {word}, {negate}");
                for it in wanted {
                    seen[usize::from(it == 0) + 2 * usize::from(it == 100)] += 1;
                }
            }
        }
    }
    assert!(seen.iter().all(|it| *it > 500), "{seen:?}");
}

/// Greys as `gm convert -type Grayscale -depth 8` of `GraphicsMagick` 1.3.40 makes them.
#[test]
fn colours_are_as_grey_as_graphicsmagick_makes_them() {
    for (color, shade) in [
        ([79, 216, 49], 156),
        ([115, 110, 246], 127),
        ([242, 173, 185], 195),
        ([26, 31, 202], 49),
        ([194, 53, 113], 102),
        ([148, 11, 213], 74),
        ([211, 172, 140], 180),
        ([61, 154, 161], 126),
    ] {
        let data: Vec<u8> = color.into_iter().cycle().take(3 * SIZE[0] * SIZE[1]).collect();
        let bytes = png(ColorType::Rgb, BitDepth::Eight, &[], &data);
        let metadata = Metadata { mode: Mode::Scale, ..metadata("scale", true) };
        // Between these thresholds each grey up to 100 is its own value.
        let all = Metadata { free_thresh: 0.0, occupied_thresh: 100.0 / 255.0, ..metadata };
        let found = Map::read(&all, "x", &bytes).unwrap().values()[0];
        assert_eq!(found, shade.min(100) as i8, "{color:?}");
        let raw = Metadata { mode: Mode::Raw, ..all };
        let found = Map::read(&raw, "x", &bytes).unwrap().values()[0];
        assert_eq!(found, if shade > 100 { -1 } else { shade as i8 }, "{color:?}");
    }
}

#[test]
fn the_text_is_read_as_yaml_cpp_reads_it() {
    let read = |text: &str| Metadata::parse("a.yaml", text).unwrap();
    let (plain, warnings) = read(TEXT);
    assert!(warnings.is_empty());
    for (from, to) in [
        ("negate: 0", "negate: no"),
        ("negate: 0", "negate: FALSE"),
        ("negate: 0", "negate: 0x0"),
        ("resolution: 0.05", "resolution: '5e-2'"),
        ("mode: trinary\n", ""),
        ("trinary", "TriNary"),
        ("[-1.0, -2.5, 0.0]", "\n  - -1\n  - -25e-1\n  - 0"),
        ("image: a.pgm", "image: &name a.pgm"),
        ("occupied_thresh: 0.65", "occupied_thresh: 0.65\n---\nanother: document"),
        ("image: a.pgm", "# a comment\n\"image\": \"a.pgm\""),
    ] {
        let text = TEXT.replace(from, to);
        let text = if to.contains("---") { TEXT.to_owned() + "---\nanother: one\n" } else { text };
        assert_eq!(read(&text).0, plain, "{to}");
    }
    let said = |text: &str| {
        let warnings = read(text).1;
        warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
    };
    let yaw = "a.yaml:4:9: warning: the yaw 0.5 is not used; turn the image";
    assert_eq!(said(&TEXT.replace("0.0]", "0.5]")), yaw);
    let twice = "a.yaml:8:1: warning: `negate` is there twice: first wins";
    assert_eq!(said(&(TEXT.to_owned() + "negate: 1\n")), twice);
    let other = "a.yaml:8:1: warning: the key `floor` is not read";
    assert_eq!(said(&(TEXT.to_owned() + "floor: 1\n")), other);
    let low = "a.yaml:6:18: warning: `occupied_thresh` is not above `free_thresh`: free wins";
    assert_eq!(said(&TEXT.replace("0.65", "0.1")), low);
}

/// Texts and images that are wrong in one way each.
fn broken() -> Vec<(String, String)> {
    let mut said = Vec::new();
    for (from, to) in [
        ("image: a.pgm\n", ""),
        ("image: a.pgm", "image:"),
        ("image: a.pgm", "image: ''"),
        ("image: a.pgm", "image: [a.pgm]"),
        ("image:", "Image:"),
        ("resolution: 0.05\n", ""),
        ("resolution: 0.05", "resolution: 5 cm"),
        ("resolution: 0.05", "resolution: 0"),
        ("resolution: 0.05", "resolution: -0.05"),
        ("resolution: 0.05", "resolution: 1e9"),
        ("resolution: 0.05", "resolution: .nan"),
        ("resolution: 0.05", "resolution: 0,05"),
        ("resolution", "resolutoin"),
        ("origin: [-1.0, -2.5, 0.0]\n", ""),
        ("[-1.0, -2.5, 0.0]", "[-1.0, -2.5]"),
        ("[-1.0, -2.5, 0.0]", "[-1.0, -2.5, 0.0, 0.0]"),
        ("[-1.0, -2.5, 0.0]", "-1.0"),
        ("[-1.0, -2.5, 0.0]", "[-1.0, left, 0.0]"),
        ("[-1.0, -2.5, 0.0]", "[-1.0, 1e300, 0.0]"),
        ("[-1.0, -2.5, 0.0]", "{x: 1, y: 2}"),
        ("[-1.0, -2.5, 0.0]", "[-1.0, -2.5, .inf]"),
        ("[-1.0, -2.5, 0.0]", "[-1.0, -2.5, 0.0"),
        ("negate: 0\n", ""),
        ("negate: 0", "negate: 0.5"),
        ("negate: 0", "negate: perhaps"),
        ("negate: 0", "negate: tRUE"),
        ("negate: 0", "negate:"),
        ("occupied_thresh: 0.65\n", ""),
        ("occupied_thresh: 0.65", "occupied_thresh: high"),
        ("occupied_thresh: 0.65", "occupied_thresh: 65 %"),
        ("occupied_thresh", "ocupied_thresh"),
        ("free_thresh: 0.196", "free_thresh: [0.196]"),
        ("free_thresh", "free_treshold"),
        ("mode: trinary", "mode: ternary"),
        ("mode: trinary", "mode: [raw]"),
        ("mode: trinary", "mode: trinry"),
        ("mode: trinary", "mode: \"trinary"),
        ("mode: trinary", "mode: trinary: raw"),
        ("mode: trinary", "\tmode: trinary"),
        ("mode: trinary", "mode: *unknown"),
    ] {
        let text = TEXT.replacen(from, to, 1);
        let errors = Metadata::parse("a.yaml", &text).unwrap_err();
        said.push((format!("{from:?} -> {to:?}"), errors.to_string()));
    }
    for text in ["", "- a\n- b\n", "just words", "a: &x [*x]", "{image: a.pgm}"] {
        let errors = Metadata::parse("a.yaml", text).unwrap_err();
        said.push((format!("the text {text:?}"), errors.to_string()));
    }
    let good = png(ColorType::Grayscale, BitDepth::Eight, &[], &[7; 64]);
    let mut huge = good.clone();
    huge[16..24].copy_from_slice(&[0, 1, 0, 0, 0, 1, 0, 0]);
    with_right_sums(&mut huge);
    let mut flipped = good.clone();
    flipped[20] ^= 1;
    let images: [(&str, &[u8]); 22] = [
        ("no byte", b""),
        ("a JPEG", b"\xff\xd8\xff\xe0"),
        ("a BMP", b"BM\0\0"),
        ("a PBM", b"P1 1 1 0"),
        ("a PPM", b"P6 1 1 255 abc"),
        ("words", b"hello"),
        ("a text of a map", b"image: a.pgm"),
        ("two letters alone", b"P2"),
        ("no space", b"P2x"),
        ("no height", b"P2\n16"),
        ("a width of letters", b"P5\nwide 4 255\n"),
        ("a width of 0", b"P2\n0 4\n255\n"),
        ("a huge size", b"P5\n99999 99999\n255\n"),
        ("a number without end", b"P5\n99999999999999999999999 1\n255\n"),
        ("a largest grey of 0", b"P2\n2 1\n0\n0 0"),
        ("a largest grey of 70000", b"P2\n2 1\n70000\n0 0"),
        ("a grey too few", b"P2\n2 2\n255\n0 0 0"),
        ("a grey too large", b"P2\n2 2\n200\n0 0\n0 201"),
        ("a grey of letters", b"P2\n2 2\n255\n0 0\n0 x"),
        ("a negative grey", b"P2\n2 2\n255\n0 0\n0 -1"),
        ("bytes too few", b"P5\n2 2\n255\nabc"),
        ("a byte too large", b"P5\n2 2\n90\nABxD"),
    ];
    let pngs: [(&str, &[u8]); 4] = [
        ("half a PNG", &good[..good.len() / 2]),
        ("a PNG of its first bytes", &good[..8]),
        ("a huge PNG", &huge),
        ("a PNG with a bit changed", &flipped),
    ];
    for (name, bytes) in images.into_iter().chain(pngs) {
        let error = Map::read(&metadata("trinary", false), "a.pgm", bytes).unwrap_err();
        said.push((name.to_owned(), error.to_string()));
    }
    said
}

#[test]
fn broken_maps_are_refused_with_their_place() {
    let said = broken();
    assert!(said.len() >= 60, "{}", said.len());
    common::compare("broken_maps.txt", &said);
}

fn mutants(count: u64) {
    let texts: Vec<Vec<u8>> = vec![
        TEXT.into(),
        b"image: x\norigin:\n  - 0\n  - 0\n  - 0\nresolution: 1\nnegate: no\n\
          occupied_thresh: 0.6\nfree_thresh: 0.2\n"
            .to_vec(),
    ];
    let words = ["&a ", "*a", "[", "{", "- ", "? ", "|\n", ">\n", "!!str ", "---\n", "origin: "];
    let images: Vec<Vec<u8>> = cases().into_iter().map(|it| it.bytes).collect();
    let (mut random, mut read) = (Random(1), [0; 2]);
    let metadata = metadata("scale", false);
    for _ in 0..count {
        let text = mutant(&mut random, &texts, &words);
        let text = String::from_utf8_lossy(&text);
        match Metadata::parse("a.yaml", &text) {
            Ok(_) => read[0] += 1,
            Err(errors) => assert!(errors.to_string().starts_with("a.yaml:")),
        }
        let mut image = mutant(&mut random, &images, &["P5\n", "255\n", "9999 ", "IDAT", "tRNS"]);
        if random.below(2) == 0 {
            with_right_sums(&mut image);
        }
        match Map::read(&metadata, "a.pgm", &image) {
            Ok(map) => {
                read[1] += 1;
                assert!(map.values().iter().all(|it| (-1..=100).contains(it)));
            }
            Err(error) => assert!(error.to_string().starts_with("a.pgm:")),
        }
    }
    println!("{count} mutants: {} texts and {} images are read", read[0], read[1]);
    assert!(read.iter().all(|it| *it > count / 50 && *it < count), "{read:?}");
}

/// Gives the chunks of a PNG right check sums, so that what is in them is looked at.
fn with_right_sums(image: &mut [u8]) {
    let mut at = 8;
    while let Some(head) = image.get(at..at + 8) {
        let size = u32::from_be_bytes([head[0], head[1], head[2], head[3]]) as usize;
        let Some(chunk) = image.get(at + 4..at + 8 + size) else { return };
        let sum = chunk.iter().fold(u32::MAX, |sum, byte| {
            let mut sum = sum ^ u32::from(*byte);
            (0..8).for_each(|_| sum = (sum >> 1) ^ ((sum & 1) * 0xEDB8_8320));
            sum
        });
        let end = at + 8 + size;
        let Some(place) = image.get_mut(end..end + 4) else { return };
        place.copy_from_slice(&(!sum).to_be_bytes());
        at = end + 4;
    }
}

#[test]
fn a_thousand_mutants_are_read_or_refused() {
    mutants(1_000);
}

/// The most memory of this process so far, in KiB, where the system says it.
fn most_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|it| it.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

#[test]
#[ignore = "a minute in a release build, by hand"]
fn a_hundred_thousand_mutants_are_read_or_refused() {
    let start = std::time::Instant::now();
    mutants(100_000);
    println!("{:.1} s, {:?} KiB at most", start.elapsed().as_secs_f64(), most_memory());
    assert!(most_memory().is_none_or(|it| it < 300 << 10));
}
