//! A plan as a drawing: passes as boxes in columns by depth, connections in the colour of their slot, passes that do not run
//! in grey; below, which port is in which slot and when.

use std::fmt::Write;

use super::chart;
use super::layout::{End, Layout, Line, Point, Rectangle, layout, line_middle, row};
use super::names::{byte_words, culled_words, kind_words};
use crate::graph::{Pass, PortRef};
use crate::handle::{Handle, Table};
use crate::plan::{Plan, Slot};
use crate::signature::RoleKind;

pub(super) const GREY: &str = "#b4b8bf";
const TEXT: &str = "#1d2330";
const FAINT: &str = "#6b7280";

pub(super) type Colours = Table<Slot, String>;

/// A plan as an SVG file.
pub fn svg(plan: &Plan) -> String {
    let layout = layout(&plan.graph);
    let below = chart::chart(plan, layout.size.1 + 20.0);
    let width = layout.size.0.max(below.width).ceil();
    let height = below.bottom.ceil();
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"DejaVu Sans, Verdana, sans-serif\" font-size=\"12\" fill=\"{TEXT}\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
    );
    let colours = slot_colours(plan);
    for line in &layout.lines {
        draw_line(&mut text, plan, line, &layout, &colours);
    }
    for (pass, place) in layout.boxes.entries() {
        draw_box(&mut text, plan, pass, *place, &colours);
    }
    for (output, place) in layout.tags.iter().enumerate() {
        draw_tag(&mut text, plan, output, *place);
    }
    text.push_str(&below.text);
    text.push_str("</svg>\n");
    text
}

/// A colour for each slot: one of its own where ports share it, a common one otherwise.
pub(super) fn slot_colours(plan: &Plan) -> Colours {
    let mut shared = 0;
    let colour = |slot: Handle<Slot>| {
        if plan.ports_in(slot).nth(1).is_none() {
            return "#64748b".to_owned();
        }
        shared += 1;
        // Steps of the golden angle keep neighbouring colours distinct.
        let hue = (205.0 + 137.508 * f64::from(shared - 1)) % 360.0;
        format!("hsl({hue:.0}, 62%, 43%)")
    };
    plan.slots.handles().map(colour).collect()
}

fn colour_of(plan: &Plan, port: PortRef, colours: &Colours) -> Option<(Handle<Slot>, String)> {
    let planned = plan.planned(port).filter(|planned| plan.ports[*planned].port == port)?;
    let slot = plan.ports[planned].slot;
    Some((slot, colours[slot].clone()))
}

fn draw_line(text: &mut String, plan: &Plan, line: &Line, layout: &Layout, colours: &Colours) {
    let runs = match line.to {
        End::Port(to) => plan.position(to.pass).is_some(),
        End::Output(_) => true,
    };
    // What flows through a disabled pass has the colour of the slot that it comes from.
    let slot = plan.planned(line.from).filter(|_| runs).map(|planned| plan.ports[planned].slot);
    let colour = slot.map_or(GREY, |slot| &colours[slot]);
    let to = match line.to {
        End::Port(to) => plan.graph.port_name(to),
        End::Output(output) => plan.graph.outputs[output].0.clone(),
    };
    let path = if line.history { back(line, layout) } else { along(&line.points) };
    let dashes = if line.history { " stroke-dasharray=\"6 4\"" } else { "" };
    let from = plan.graph.port_name(line.from);
    let frame = if line.history { " of the frame before" } else { "" };
    let _ = writeln!(
        text,
        "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"{dashes}><title>{from}{frame} → {to}</title></path>"
    );
}

/// A smooth line through points, level at each.
fn along(points: &[Point]) -> String {
    let mut path = format!("M{:.1} {:.1}", points[0].0, points[0].1);
    for pair in points.windows(2) {
        let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
        if (y0 - y1).abs() < 0.05 {
            let _ = write!(path, " L{x1:.1} {y1:.1}");
            continue;
        }
        let bend = ((x1 - x0).abs() * 0.5).max(20.0);
        let _ = write!(path, " C{:.1} {y0:.1} {:.1} {y1:.1} {x1:.1} {y1:.1}", x0 + bend, x1 - bend);
    }
    path
}

/// A line that goes back below the boxes.
fn back(line: &Line, layout: &Layout) -> String {
    let ((x0, y0), (x1, y1)) = (line.points[0], line.points[line.points.len() - 1]);
    let bottom = |pass: Handle<Pass>| layout.boxes[pass].y + layout.boxes[pass].height;
    let low = match line.to {
        End::Port(to) => bottom(line.from.pass).max(bottom(to.pass)) + 12.0,
        End::Output(_) => y0,
    };
    let (right, left) = (x0 + 24.0, x1 - 24.0);
    format!(
        "M{x0:.1} {y0:.1} C{right:.1} {y0:.1} {right:.1} {low:.1} {x0:.1} {low:.1} L{x1:.1} {low:.1} \
         C{left:.1} {low:.1} {left:.1} {y1:.1} {x1:.1} {y1:.1}"
    )
}

fn draw_box(text: &mut String, plan: &Plan, pass: Handle<Pass>, place: Rectangle, colours: &Colours) {
    let of_pass = plan.graph.pass(pass);
    let position = plan.position(pass);
    let culled = plan.culled.binary_search_by_key(&pass, |culled| culled.pass).ok().map(|index| &plan.culled[index]);
    let (ink, faint, fill, border) = match culled {
        None => (TEXT, FAINT, "#f8fafc", "#475569"),
        Some(_) => (GREY, GREY, "#ffffff", GREY),
    };
    let dashes = if culled.is_some() { " stroke-dasharray=\"4 3\"" } else { "" };
    let Rectangle { x, y, width, height } = place;
    let why = culled.map_or_else(|| of_pass.descriptor().about.clone(), |culled| culled_words(plan, culled));
    let _ = write!(
        text,
        "<g><title>{}: {}</title><rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" rx=\"6\" \
         fill=\"{fill}\" stroke=\"{border}\"{dashes}/>\n\
         <text x=\"{:.1}\" y=\"{:.1}\" font-weight=\"bold\" font-size=\"13\" fill=\"{ink}\">{}</text>\n\
         <text x=\"{:.1}\" y=\"{:.1}\" font-size=\"11\" fill=\"{faint}\">{}</text>\n",
        escaped(&of_pass.name),
        escaped(&why),
        x + 12.0,
        y + 18.0,
        escaped(&of_pass.name),
        x + 12.0,
        y + 33.0,
        escaped(&of_pass.descriptor().name),
    );
    if let Some(position) = position {
        let _ = writeln!(
            text,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\" font-size=\"11\" fill=\"{FAINT}\">{}</text>",
            x + width - 10.0,
            y + 18.0,
            position.index() + 1
        );
    }
    for port in of_pass.descriptor().ports.handles() {
        draw_port(text, plan, PortRef { pass, port }, place, (ink, faint), colours);
    }
    text.push_str("</g>\n");
}

fn draw_port(
    text: &mut String,
    plan: &Plan,
    port: PortRef,
    place: Rectangle,
    (ink, faint): (&str, &str),
    colours: &Colours,
) {
    let role = plan.graph.signature(port).role;
    let descriptor = plan.graph.port(port);
    if role.is_input() {
        let y = place.y + line_middle(row(&plan.graph, port, false));
        let unfed = plan
            .position(port.pass)
            .is_some_and(|position| role == RoleKind::Optional && plan.sources(position)[port.port].is_none());
        let ink = if unfed { faint } else { ink };
        let _ = writeln!(
            text,
            "<circle cx=\"{:.1}\" cy=\"{y:.1}\" r=\"3.5\" fill=\"{}\" stroke=\"{ink}\"/><text x=\"{:.1}\" y=\"{:.1}\" fill=\"{ink}\">{}</text>",
            place.x,
            if unfed { "#ffffff" } else { ink },
            place.x + 12.0,
            y + 4.0,
            escaped(&descriptor.name)
        );
    }
    if role.is_output() {
        let y = place.y + line_middle(row(&plan.graph, port, true));
        let right = place.x + place.width;
        let slot = colour_of(plan, port, colours);
        let colour = slot.as_ref().map_or(GREY, |(_, colour)| colour);
        let tip = slot.as_ref().map(|(slot, _)| {
            let of_slot = &plan.slots[*slot];
            let kind = kind_words(plan, of_slot.kind);
            format!("slot {slot}: {}, {}, {kind}", of_slot.resource, byte_words(of_slot.resource.bytes()))
        });
        let _ = writeln!(
            text,
            "<g><title>{}</title><circle cx=\"{right:.1}\" cy=\"{y:.1}\" r=\"4.5\" fill=\"{colour}\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\" fill=\"{ink}\">{}</text></g>",
            escaped(&tip.unwrap_or_default()),
            right - 12.0,
            y + 4.0,
            escaped(&descriptor.name)
        );
        if let Some((slot, colour)) = slot {
            let _ = writeln!(
                text,
                "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"9\" fill=\"{colour}\">{slot}</text>",
                right + 7.0,
                y - 4.0
            );
        }
    }
}

fn draw_tag(text: &mut String, plan: &Plan, output: usize, place: Rectangle) {
    let Rectangle { x, y, width, height } = place;
    let _ = writeln!(
        text,
        "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" rx=\"13\" fill=\"#1e293b\"/>\
         <text x=\"{:.1}\" y=\"{:.1}\" fill=\"#ffffff\">{}</text>",
        x + 14.0,
        y + height / 2.0 + 4.5,
        escaped(&plan.graph.outputs[output].0)
    );
}

/// Text escaped for XML; control characters, which XML cannot hold, are left out.
pub(super) fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            letter if letter.is_control() => escaped.push(' '),
            letter => escaped.push(letter),
        }
    }
    escaped
}
