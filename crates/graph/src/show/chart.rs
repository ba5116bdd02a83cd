//! The lower part of the drawing: slots as rows, positions as columns, ports as bars.

use std::fmt::Write;

use super::layout::text_width;
use super::names::{byte_words, kind_words, readers};
use super::svg::{GREY, escaped, slot_colours};
use crate::handle::{Handle, Table};
use crate::plan::{Plan, PlannedPass, PlannedPort, Slot, SlotKind, Until};

const ROW: f64 = 26.0;
const LEFT: f64 = 26.0;
/// Greatest total width of all positions.
const WIDEST: f64 = 4000.0;
/// Smallest width of a position with its pass's name.
const NARROWEST: f64 = 12.0;

/// The chart, and where it ends.
pub(super) struct Chart {
    pub text: String,
    pub width: f64,
    pub bottom: f64,
}

/// Draws the chart from `top` on.
pub(super) fn chart(plan: &Plan, top: f64) -> Chart {
    let labels: Table<Slot, String> = plan.slots.handles().map(|slot| slot_label(plan, slot)).collect();
    let names = labels.iter().map(|label| text_width(label)).fold(0.0, f64::max);
    let left = LEFT + names + 16.0;
    let passes = plan.passes.len();
    let longest = plan.ports.iter().map(|port| text_width(&plan.graph.port_name(port.port))).fold(40.0, f64::max);
    let step = (longest + 12.0).clamp(24.0, 110.0).min(WIDEST / passes.max(1) as f64);
    let header = plan.passes.handles().map(|position| text_width(plan.pass_name(position))).fold(0.0, f64::max);
    let slanted = header > step - 8.0;
    let first_row = top + 54.0 + if slanted { header * 0.65 } else { 0.0 };
    let mut chart = Drawing { plan, readers: readers(plan), text: String::new(), left, step, first_row };
    chart.title(top);
    chart.columns(slanted);
    let colours = slot_colours(plan);
    for (slot, label) in labels.entries() {
        chart.slot(slot, label, &colours[slot]);
    }
    let bottom = first_row + ROW * plan.slots.len() as f64 + 24.0;
    let width = left + step * (passes as f64 + 0.5) + if slanted { header * 0.75 } else { 0.0 } + 30.0;
    Chart { text: chart.text, width, bottom }
}

fn slot_label(plan: &Plan, slot: Handle<Slot>) -> String {
    let of_slot = &plan.slots[slot];
    format!("{slot}  {}  {}", of_slot.resource, byte_words(of_slot.resource.bytes()))
}

struct Drawing<'a> {
    plan: &'a Plan,
    readers: Table<PlannedPort, Vec<Handle<PlannedPass>>>,
    text: String,
    left: f64,
    step: f64,
    first_row: f64,
}

// Writing to a string cannot fail, so the results of `write!` are dropped.
impl Drawing<'_> {
    fn title(&mut self, top: f64) {
        let bytes = &self.plan.bytes;
        let _ = writeln!(
            self.text,
            "<text x=\"{LEFT}\" y=\"{:.1}\" font-size=\"15\" font-weight=\"bold\">Memory</text>\
             <text x=\"{:.1}\" y=\"{:.1}\">transient {} shared, {} unshared; this plan {} at {}×{}</text>",
            top + 14.0,
            LEFT + 80.0,
            top + 14.0,
            byte_words(bytes.shared),
            byte_words(bytes.unshared),
            byte_words(bytes.allocated),
            self.plan.size.0,
            self.plan.size.1
        );
    }

    fn columns(&mut self, slanted: bool) {
        for position in self.plan.passes.handles() {
            let x = self.left + self.step * position.index() as f64;
            let bottom = self.first_row + ROW * self.plan.slots.len() as f64;
            if self.step < NARROWEST {
                continue;
            }
            let (text_x, text_y) = (x + 6.0, self.first_row - 8.0);
            let turn =
                if slanted { format!(" transform=\"rotate(-40 {text_x:.1} {text_y:.1})\"") } else { String::new() };
            let _ = writeln!(
                self.text,
                "<line x1=\"{x:.1}\" y1=\"{:.1}\" x2=\"{x:.1}\" y2=\"{bottom:.1}\" stroke=\"#e2e8f0\"/>\
                 <text x=\"{text_x:.1}\" y=\"{text_y:.1}\" fill=\"#6b7280\" font-size=\"11\"{turn}>{}</text>",
                self.first_row - 4.0,
                escaped(self.plan.pass_name(position))
            );
        }
    }

    fn slot(&mut self, slot: Handle<Slot>, label: &str, colour: &str) {
        let y = self.first_row + ROW * slot.index() as f64;
        let _ = writeln!(self.text, "<text x=\"{LEFT}\" y=\"{:.1}\">{}</text>", y + 17.0, escaped(label));
        let kind = self.plan.slots[slot].kind;
        if matches!(kind, SlotKind::Constant(_) | SlotKind::History { .. }) {
            let words = kind_words(self.plan, kind);
            self.bar(0.0, self.plan.passes.len() as f64, y, (GREY, &words, &words));
        }
        for port in self.plan.ports_in(slot) {
            let PlannedPort { pass: Some(first), until, .. } = self.plan.ports[port] else { continue };
            let end = match until {
                Until::Pass(last) => last.index() as f64 + 1.0,
                Until::End => self.plan.passes.len() as f64 + 0.35,
            };
            let (name, first) = (self.plan.port_name(port), first.index());
            let tip = format!("{name}: written at {}, read at {}", first + 1, numbers(&self.readers[port]));
            self.bar(first as f64, self.free_end(port, end), y, (colour, &name, &tip));
        }
    }

    /// Where the bar of a port ends: before the next version made in place, if that is in the same slot.
    fn free_end(&self, port: Handle<PlannedPort>, end: f64) -> f64 {
        let slot = self.plan.ports[port].slot;
        let next = self.plan.ports_in(slot).skip_while(|other| *other != port).nth(1);
        match next.map(|next| &self.plan.ports[next]) {
            Some(PlannedPort { in_place: true, pass: Some(first), .. }) => first.index() as f64,
            _ => end,
        }
    }

    fn bar(&mut self, from: f64, to: f64, y: f64, (colour, name, tip): (&str, &str, &str)) {
        let (x, width) = (self.left + self.step * from, self.step * (to - from));
        let name = if text_width(name) * 0.92 < width - 8.0 { name } else { "" };
        let _ = writeln!(
            self.text,
            "<g><title>{}</title><rect x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\" rx=\"3\" fill=\"{colour}\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\" fill=\"#ffffff\" font-size=\"11\">{}</text></g>",
            escaped(tip),
            x + 1.0,
            y + 3.0,
            (width - 2.0).max(1.0),
            ROW - 6.0,
            x + 6.0,
            y + 17.0,
            escaped(name)
        );
    }
}

fn numbers(positions: &[Handle<PlannedPass>]) -> String {
    match positions {
        [] => "none".to_owned(),
        _ => positions.iter().map(|position| (position.index() + 1).to_string()).collect::<Vec<_>>().join(", "),
    }
}
