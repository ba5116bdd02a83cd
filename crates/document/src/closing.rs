//! Closing brackets: missing ones, wrong ones, and which bracket was probably meant.

use crate::reader::{Held, Reader, space_end};
use crate::{MISPLACED_ENTRY, UNCLOSED_BRACKET, UNOPENED_BRACKET};

impl Reader<'_> {
    /// Reports a held mistake, which was counted when it was held.
    pub fn report_held(&mut self, held: Held) {
        self.errors -= 1;
        self.report(held.diagnostic);
    }

    /// Reports a closing bracket of a kind that is not open, and moves over it. It may have been meant as that of the
    /// innermost bracket (then true), or be one too many.
    pub fn report_wrong_closing(&mut self, opened: usize, close: u8) -> bool {
        let next = space_end(self.bytes, self.at + 1).ok().and_then(|at| self.bytes.get(at)).copied();
        let outer = self.open.len().checked_sub(2).map(|index| self.open[index].close);
        if next == Some(close) && outer != Some(close) {
            self.report_unopened();
            return false;
        }
        let message = format!("{} does not close `{}`", self.token(self.at), char::from(self.bytes[opened]));
        let error = self.error(UNOPENED_BRACKET, self.at, self.at + 1, message);
        let place = self.place(opened, opened + 1);
        self.brackets_broken = true;
        self.at += 1;
        self.report(error.suggest(format!("write `{}`", char::from(close))).relate(place, "opened here"));
        true
    }

    /// Reports a closing bracket that closes nothing, and moves over it.
    pub fn report_unopened(&mut self) {
        let message = format!("{} has no opening bracket", self.token(self.at));
        let error = self.error(UNOPENED_BRACKET, self.at, self.at + 1, message);
        self.brackets_broken = true;
        self.at += 1;
        self.report(error);
    }

    /// The closing bracket here is that of a bracket further out, so the one in between is not closed. Items that do not
    /// suit it come after its missing end, so the first of them is where it was noticed.
    pub fn report_unclosed(&mut self, opened: usize, held: usize) {
        let mut others: Vec<_> = self.held.drain(held..).collect();
        let misplaced = others.iter().position(|held| held.diagnostic.code == MISPLACED_ENTRY);
        let noticed = misplaced.map_or(self.at, |index| others[index].item);
        if let Some(index) = misplaced {
            let comma_before = index > 0 && others[index - 1].item == noticed;
            self.errors -= others.len() - index + usize::from(comma_before);
            others.truncate(index - usize::from(comma_before));
        }
        others.into_iter().for_each(|held| self.report_held(held));
        let message = format!("this `{}` is not closed", char::from(self.bytes[opened]));
        let place = self.place(noticed, self.token_end(noticed));
        let what = format!("it should be closed before {}", self.token(noticed));
        let error = self.error(UNCLOSED_BRACKET, opened, opened + 1, message).relate(place, what);
        self.brackets_broken = true;
        self.report(error);
    }

    /// The text ends within brackets: one report for all of them. The likeliest culprit is one whose closing bracket is
    /// indented differently, for that was meant to close another one.
    pub fn report_end_within(&mut self, opened: usize, held: usize) {
        let others: Vec<_> = self.held.drain(held..).collect();
        let (misplaced, others): (Vec<_>, Vec<_>) =
            others.into_iter().partition(|held| held.diagnostic.code == MISPLACED_ENTRY);
        self.errors -= misplaced.len();
        let suspect_held = std::mem::take(&mut self.suspect_held);
        self.errors -= suspect_held.len();
        others.into_iter().for_each(|held| self.report_held(held));
        if self.ends_in_comment {
            return;
        }
        let place = self.place(opened, opened + 1);
        if let Some(index) = self.ended_within {
            const MOST_RELATED: usize = 3;
            if let Some(report) = self.out.get_mut(index).filter(|report| report.related.len() < MOST_RELATED) {
                report.related.push((place, "this one is not closed either".to_owned()));
            }
            return;
        }
        let last = self.last();
        let end = self.place(last, last);
        let bracket = |at: usize| char::from(self.bytes[at]);
        let error = match (self.suspect, misplaced.first()) {
            (Some((suspect, closed)), _) => {
                let message = format!("this `{}` is not closed where it should be", bracket(suspect));
                self.error(UNCLOSED_BRACKET, suspect, suspect + 1, message)
                    .relate(self.place(closed, closed + 1), "closed here, which by its indentation closes another one")
                    .relate(place, format!("so this `{}` is still open at the end", bracket(opened)))
            }
            (None, Some(held)) => {
                let noticed = self.place(held.item, self.token_end(held.item));
                let what = format!("it should be closed before {}", self.token(held.item));
                self.error(UNCLOSED_BRACKET, opened, opened + 1, format!("this `{}` is not closed", bracket(opened)))
                    .relate(noticed, what)
            }
            (None, None) => self
                .error(UNCLOSED_BRACKET, opened, opened + 1, format!("this `{}` is not closed", bracket(opened)))
                .relate(end, "it is still open at the end"),
        };
        self.brackets_broken = true;
        self.ended_within = Some(self.out.len());
        self.report(error);
    }

    /// Remembers the first closing bracket that begins a line and is indented differently from the line of its opening
    /// bracket. Returns whether this is it.
    pub fn note_suspect(&mut self, opened: usize) -> bool {
        let before = &self.bytes[..self.at];
        let indentation = before.iter().rev().take_while(|byte| matches!(byte, b' ' | b'\t')).count();
        let (rest, indentation) = before.split_at(before.len() - indentation);
        let begins_line = rest.len() > opened + 1 && rest.ends_with(b"\n");
        if self.suspect.is_some() || !begins_line || self.indentation(opened) == indentation {
            return false;
        }
        self.suspect = Some((opened, self.at));
        true
    }

    /// Reports what was held when a bracket seemed to be closed in the wrong place, because it was not.
    pub fn report_suspect_held(&mut self) {
        let held = std::mem::take(&mut self.suspect_held);
        held.into_iter().for_each(|held| self.report_held(held));
    }

    /// The space at the start of the line of an offset.
    fn indentation(&self, at: usize) -> &[u8] {
        let line = self.source.line_index(at as u32);
        let line = &self.bytes[self.source.line_span(line, line).start as usize..];
        &line[..line.iter().take_while(|byte| matches!(byte, b' ' | b'\t')).count()]
    }
}
