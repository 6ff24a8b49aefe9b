//! Rows of probabilities as they are printed: rounded, so that their sum may miss 1.

/// A row of a table.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    /// Begin, in bytes.
    at: usize,
    numbers: Vec<f64>,
    /// The most digits behind the point of any of its numbers.
    digits: i32,
    /// Half a unit of the last digit of each number, together.
    rounding: f64,
}

/// The most by which units of numbers of their own may add up.
const OWN: f64 = 1e-5;

/// The rounding of a number of single precision, as pyAgrum writes them with all digits.
const SINGLE: f64 = 1.0 / (1_u32 << 24) as f64;

/// A sum as near to 1 as this needs no word.
const EXACT: f64 = 1e-12;

impl Row {
    pub(crate) const fn new(at: usize) -> Self {
        Self { at, numbers: Vec::new(), digits: 0, rounding: 0.0 }
    }

    /// Adds a number as it is written.
    pub(crate) fn push(&mut self, word: &str) -> Result<(), String> {
        let number: f64 = word.parse().map_err(|_| format!("`{word}` is no probability"))?;
        if !number.is_finite() || !(0.0..=1.5).contains(&number) {
            return Err(format!("probability {word}"));
        }
        let (mantissa, exponent) = word.split_once(['e', 'E']).unwrap_or((word, "0"));
        let behind = mantissa.split_once('.').map_or(0, |it| it.1.len().min(400) as u16);
        let exponent = exponent.parse().unwrap_or(0_i32).clamp(-400, 400);
        let digits = i32::from(behind) - exponent;
        self.digits = self.digits.max(digits);
        self.rounding += 0.5 * libm::pow(10.0, -f64::from(digits));
        self.numbers.push(number);
        Ok(())
    }

    /// The row with a sum of 1: as it is, or normalised with a note if it misses that by less than
    /// half a unit of the last printed digit for each number. Numbers that are printed with as
    /// many digits each, wherever their point is, have each a unit of their own, as far as that is
    /// small; of numbers of single precision their bits count.
    pub(crate) fn normalised(self, notes: &mut Notes) -> Result<Vec<f64>, (usize, String)> {
        let sum: f64 = self.numbers.iter().sum();
        let off = (sum - 1.0).abs();
        if off <= EXACT {
            return Ok(self.numbers);
        }
        let unit = libm::pow(10.0, -f64::from(self.digits));
        let allowed = 0.5 * unit * self.numbers.len() as f64;
        let own = if self.rounding < OWN { self.rounding } else { OWN };
        let single = SINGLE * self.numbers.len() as f64;
        let allowed = [own, single].iter().fold(allowed, |most, it| most.max(*it));
        // Just as much is a slip of a person in a row of two digits; six digits are rounded twice.
        let allowed = allowed * if allowed < OWN { 1.0 + 1e-6 } else { 1.0 - 1e-6 };
        if off >= allowed || sum <= 0.0 {
            let sum = (sum * 1e9).round() / 1e9;
            return Err((self.at, format!("sums to {sum}")));
        }
        notes.rows += 1;
        notes.first.get_or_insert(self.at);
        Ok(self.numbers.iter().map(|it| it / sum).collect())
    }
}

/// Rows that were normalised.
#[derive(Debug, Default)]
pub(crate) struct Notes {
    rows: usize,
    /// Begin of the first one, in bytes.
    first: Option<usize>,
}

impl Notes {
    /// A note, if there is something to say; `line` is the line of a byte.
    pub(crate) fn told(&self, line: impl Fn(usize) -> usize) -> Vec<String> {
        let Some(line) = self.first.map(line) else { return Vec::new() };
        let rows = self.rows;
        let row = if rows == 1 { "row misses" } else { "rows miss" };
        vec![format!(
            "{rows} {row} a sum of 1 by less than the rounding of its numbers, and is normalised: \
             line {line}{}",
            if rows == 1 { "" } else { " first" }
        )]
    }
}
