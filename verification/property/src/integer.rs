//! Whole numbers.

use std::ops::Rem;

/// The greatest common divisor of two numbers; that of a number and 0 is the number.
pub fn gcd<T: Copy + Default + PartialEq + Rem<Output = T>>(mut a: T, mut b: T) -> T {
    while b != T::default() {
        (a, b) = (b, a % b);
    }
    a
}
