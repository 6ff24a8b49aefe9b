//! Points of a plane: `[x, y]`, and lists of them.

use super::{Fields, Node, Reported};
use crate::missions::diagnostic::{Diagnostic, Spanned};
use std::ops::RangeInclusive;
use toml::de::DeValue;

/// A point `[x, y]` and its place.
type Point = Spanned<[i64; 2]>;

impl<'t> Fields<'t> {
    fn point_of(&self, key: &str, node: &Node<'_>, range: &RangeInclusive<i64>) -> Option<Point> {
        let DeValue::Array(array) = node.get_ref() else {
            self.wrong_type(key, node, "a point `[x, y]`");
            return None;
        };
        if array.len() != 2 {
            let noun = if array.len() == 1 { "number" } else { "numbers" };
            let message = format!("`{key}` must be a point `[x, y]`, not {} {noun}", array.len());
            let it = Diagnostic::new(node.span(), message, "no point");
            self.report(it.help("write two whole numbers, first to the right, then up"));
            return None;
        }
        // Both are looked at before giving up.
        let both: Vec<Option<i64>> =
            array.iter().map(|it| self.integer_of(key, it, range)).collect();
        let both = both.into_iter().collect::<Option<Vec<_>>>()?;
        Some(Spanned { value: both.try_into().ok()?, span: node.span() })
    }

    /// A required point `[x, y]`, both numbers within a range.
    pub fn point(&mut self, key: &'static str, range: &RangeInclusive<i64>) -> Option<Point> {
        let node = self.required(key)?;
        self.point_of(key, node, range)
    }

    /// A point that may be left out.
    ///
    /// # Errors
    /// When it is wrong; that is reported.
    pub fn optional_point(
        &mut self,
        key: &'static str,
        range: &RangeInclusive<i64>,
    ) -> Result<Option<Point>, Reported> {
        match self.optional(key) {
            None => Ok(None),
            Some(node) => self.point_of(key, node, range).map(Some).ok_or(Reported),
        }
    }

    fn points_of(
        &self,
        key: &str,
        node: &'t Node<'t>,
        range: &RangeInclusive<i64>,
        counts: &RangeInclusive<usize>,
    ) -> Option<Vec<Point>> {
        let DeValue::Array(array) = node.get_ref() else {
            self.wrong_type(key, node, "a list of points `[x, y]`");
            return None;
        };
        if !counts.contains(&array.len()) {
            let (least, most) = (counts.start(), counts.end());
            let noun = if array.len() == 1 { "point" } else { "points" };
            let message = format!("`{key}` has {} {noun}; {least} to {most} are", array.len());
            let it = Diagnostic::new(node.span(), message + " allowed", "so many points");
            let few = array.len() < *least;
            self.report(it.help(if few { "add points" } else { "make two of it" }));
            return None;
        }
        let all: Vec<_> = array.iter().map(|it| self.point_of(key, it, range)).collect();
        all.into_iter().collect()
    }

    /// A required list of points.
    pub fn points(
        &mut self,
        key: &'static str,
        range: &RangeInclusive<i64>,
        counts: &RangeInclusive<usize>,
    ) -> Option<Vec<Point>> {
        let node = self.required(key)?;
        self.points_of(key, node, range, counts)
    }

    /// A list of points that may be left out.
    ///
    /// # Errors
    /// When it is wrong; that is reported.
    pub fn optional_points(
        &mut self,
        key: &'static str,
        range: &RangeInclusive<i64>,
        counts: &RangeInclusive<usize>,
    ) -> Result<Option<Vec<Point>>, Reported> {
        match self.optional(key) {
            None => Ok(None),
            Some(node) => self.points_of(key, node, range, counts).map(Some).ok_or(Reported),
        }
    }
}
