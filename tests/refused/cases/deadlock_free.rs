//! Two arms each take one tool and wait for the other.
cotama_core::net! {
    pub mod arms {
        places { Pen: 1, Ruler: 1, LeftIdle: 1, LeftPen, RightIdle: 1, RightRuler }
        events { Left, Right }
        transitions {
            left_pen    on Left:  LeftIdle & Pen => LeftPen;
            left_draw   on Left:  LeftPen & Ruler => LeftIdle & Pen & Ruler;
            right_ruler on Right: RightIdle & Ruler => RightRuler;
            right_draw  on Right: RightRuler & Pen => RightIdle & Pen & Ruler;
        }
        laws { deadlock_free; }
    }
}
