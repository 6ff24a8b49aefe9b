//! Two tokens are no state.
cotama_core::net! {
    /// Two lamps.
    pub mod lamps {
        places { LeftDark: 1, LeftLit, RightDark: 1, RightLit }
        events { Left, Right }
        transitions {
            left  on Left:  LeftDark => LeftLit;
            right on Right: RightDark => RightLit;
        }
    }
}

/// Asks for the one marked place.
pub fn lit() -> lamps::State {
    lamps::Player::new().state()
}
