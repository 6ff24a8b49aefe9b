//! Whether transitions that fire at once by themselves come to an end.

use super::explore::{AT_ONCE, MARKINGS, NONE, said};
use super::laws::Check;

impl<const W: usize> Check<'_, W> {
    /// Checks that transitions which fire at once by themselves come to an end; gives back after
    /// how many.
    pub(super) const fn settles(&self) -> u32 {
        // How many such firings leave a marking to one that is not known to settle.
        let mut open = [0_u16; MARKINGS];
        let mut any = false;
        let mut firing = 0;
        while firing < self.graph.fired {
            if self.graph.firings[firing].kind == AT_ONCE {
                open[self.graph.firings[firing].from as usize] += 1;
                any = true;
            }
            firing += 1;
        }
        if !any {
            return 0;
        }
        let mut queue = [0_u16; MARKINGS];
        let mut settled = 0;
        let mut marking = 0;
        while marking < self.graph.count {
            if open[marking] == 0 {
                queue[settled] = marking as u16;
                settled += 1;
            }
            marking += 1;
        }
        let mut depths = [0_u32; MARKINGS];
        let (mut most, mut next) = (0, 0);
        while next < settled {
            let to = queue[next] as usize;
            let mut firing = self.graph.arrivals[to];
            while firing != NONE {
                let it = &self.graph.firings[firing as usize];
                if it.kind == AT_ONCE {
                    let from = it.from as usize;
                    if depths[from] <= depths[to] {
                        depths[from] = depths[to] + 1;
                    }
                    open[from] -= 1;
                    if open[from] == 0 {
                        queue[settled] = it.from;
                        settled += 1;
                    }
                }
                firing = self.graph.earlier[firing as usize];
            }
            // What settles last is the deepest of those that lead to it.
            most = if depths[to] > most { depths[to] } else { most };
            next += 1;
        }
        if settled < self.graph.count {
            self.endless(&open);
        }
        most
    }

    /// Ends the compilation: in the open markings transitions fire by themselves for ever.
    const fn endless(&self, open: &[u16; MARKINGS]) -> ! {
        let mut at = 0;
        while open[at] == 0 {
            at += 1;
        }
        // Step until a marking comes back; once round from there, what is nearest to the start.
        let mut seen = [false; MARKINGS];
        while !seen[at] {
            seen[at] = true;
            at = self.graph.firings[self.onwards(at, open)].to as usize;
        }
        let (mut start, end) = (at, at);
        loop {
            at = self.graph.firings[self.onwards(at, open)].to as usize;
            start = if at < start { at } else { start };
            if at == end {
                break;
            }
        }
        let text = self.says(
            "law `settles` does not hold: transitions without event and interval fire for ever",
        );
        let mut text =
            self.graph.way(self.net, self.code, text.with("\n  "), start).with("\n  for ever: ");
        at = start;
        loop {
            let firing = &self.graph.firings[self.onwards(at, open)];
            text = said(self.net, self.code, text, firing.by as usize);
            at = firing.to as usize;
            if at == start {
                text.with("\n  give one of them an event or an interval").stop();
            }
            text = text.with(", ");
        }
    }

    /// The first firing that stays among the open markings.
    const fn onwards(&self, marking: usize, open: &[u16; MARKINGS]) -> usize {
        let mut firing = self.graph.starts[marking] as usize;
        while self.graph.firings[firing].kind != AT_ONCE
            || open[self.graph.firings[firing].to as usize] == 0
        {
            firing += 1;
        }
        firing
    }
}
