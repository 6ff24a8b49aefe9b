//! Whether a certificate is about a model and a question of somebody's own.

use super::verified::{Checked, at, ensure};
use super::{Answer, Certificate, Net, Question, VerifyError, read};
use cotama_property::Property;
use cotama_property::pt::Pt;

impl Certificate {
    /// Reads a certificate, and checks nothing.
    ///
    /// # Errors
    /// When the text is none.
    pub fn read(text: &str) -> Result<Self, VerifyError> {
        read::certificate(text)
    }

    /// Checks that the certificate is about this net, but for its name, and this question: then its
    /// statement holds of them. `verify` asks nobody what was meant.
    ///
    /// # Errors
    /// Where they differ.
    ///
    /// ```
    /// use cotama_models::nets::door;
    /// use cotama_verification::certificate::{Certificate, Evidence, Question};
    /// use cotama_verification::property;
    /// use cotama_verification::pt::Pt;
    /// let door = Pt::from(&door::NET);
    /// let shown = Certificate::of(&door, "", Question::OneSafe, true, Evidence::Graph(8));
    /// let ask = |text| property::parse(text, &door).unwrap();
    /// assert!(shown.is_about(&door, &ask("one_safe")).is_ok());
    /// assert_eq!(shown.is_about(&door, &ask("live")).unwrap_err().at, "question");
    /// ```
    pub fn is_about(&self, pt: &Pt, property: &Property) -> Checked<()> {
        let net = Net::from(pt);
        let other = |what| format!("{what} are not those of the model");
        ensure(self.net.places == net.places, other("places and their tokens"))
            .and_then(|()| {
                let same = self.net.transitions == net.transitions;
                ensure(same, other("transitions"))
            })
            .map_err(at("net"))?;
        let answer = match self.question {
            Question::Bound { most, .. } => Answer::Bound(u64::try_from(most).unwrap_or(0)),
            Question::Unbounded { .. } => Answer::Unbounded,
            _ => Answer::Holds(self.verdict),
        };
        let asked = Question::new(pt, &property.question.simplified(), answer);
        ensure(asked.as_ref() == Ok(&self.question), "it is not the property that was asked for")
            .map_err(at("question"))
    }
}
