//! The message of a failing test.

use cotama_core::net;
use cotama_verification::assert_holds;

net! {
    /// Stops the robot when the operator falls silent.
    mod link {
        places {
            /// The operator is heard.
            Up: 1,
            /// Nothing was heard for a while.
            Down
        }
        events { Silence, Heard }
        transitions {
            lose    on Silence: Up => Down;
            recover on Heard:   Down => Up;
        }
        ignore { Silence in Down; Heard in Up; }
        laws { handles(all); deadlock_free; always_can(Up); }
    }
}

/// The text of the panic of a test.
fn said(test: impl FnOnce() + std::panic::UnwindSafe) -> String {
    let panic = std::panic::catch_unwind(test).expect_err("the test fails");
    *panic.downcast::<String>().expect("a text")
}

#[test]
fn a_property_that_does_not_hold_is_explained_by_its_counterexample() {
    assert_holds!(link::NET);
    let said = said(|| assert_holds!(link::NET, "AG !(Up & Down)", "AG Up"));
    let expected = "
AG !(Up & Down): holds (structural)
`AG Up` does not hold: after 1 firing `Up` is empty.
cause: `lose` (on `Silence`) fired: it emptied `Up`.
net:   link: Stops the robot when the operator falls silent.

   step  fires  on       changes
  start                  Up
      1  lose   Silence  -Up +Down
    end                  Down

where
  Up    The operator is heard.
  Down  Nothing was heard for a while.

";
    assert_eq!(said, expected);
}

#[test]
fn a_response_that_can_fail_for_ever_is_explained_by_the_loop() {
    let said = said(|| assert_holds!(link::NET, "A (F G Up)"));
    let expected = "
`A (F G Up)` does not hold: on a run that goes on for ever again and again `Up <= 0` holds.
cause: steps 1 and 2 repeat for ever (`lose` and `recover`), and `F Up <= 0` always holds.
net:   link: Stops the robot when the operator falls silent.

   step  fires    on       changes
  start                    Up
  from here on steps 1 and 2 repeat for ever
      1  lose     Silence  -Up +Down
      2  recover  Heard    +Up -Down
    end                    as at the start

where
  Up    The operator is heard.
  Down  Nothing was heard for a while.

";
    assert_eq!(said, expected);
}

#[test]
fn a_misspelt_place_fails_the_test_with_the_name_that_was_meant() {
    let said = said(|| assert_holds!(link::NET, "AG Upp"));
    assert_eq!(said, "property:1:4: there is no place `Upp`\n  help: did you mean `Up`?");
}
