//! Floors and maps: what is read and refused, rays, ways.

mod common;
mod exact_rays;
mod floors;
mod maps;
mod planning;
