//! Two transitions without event hand the token to and fro.
cotama_core::net! {
    pub mod toggle {
        places { Left: 1, Right }
        transitions {
            go:   Left => Right;
            back: Right => Left;
        }
    }
}
