//! Where the boxes and lines of a drawing stand: passes in columns by depth, in the manner of Sugiyama, Tagawa and Toda
//! (1981): longest paths give columns, lines that skip a column pass through it, averages of neighbours give the order.

use rustc_hash::FxHashMap;

use crate::graph::{Graph, Pass, PortRef};
use crate::handle::{Handle, Table};
use crate::signature::RoleKind;

const COLUMN_GAP: f64 = 90.0;
const ROW_GAP: f64 = 26.0;
const HEADER: f64 = 40.0;
const LINE: f64 = 20.0;
const SWEEPS: usize = 8;
/// Beyond this many passes, lines go straight: passing through columns would cost more than it shows.
const MOST_ROUTED: usize = 500;

/// A place in the drawing, in pixels.
pub(super) type Point = (f64, f64);

/// A drawing's geometry.
pub(super) struct Layout {
    pub boxes: Table<Pass, Rectangle>,
    /// By output of the graph.
    pub tags: Vec<Rectangle>,
    pub lines: Vec<Line>,
    pub size: Point,
}

#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Rectangle {
    pub x: f64,
    pub y: f64,
    pub width: f64,
    pub height: f64,
}

/// A connection from a port to a port, or to an output of the graph.
pub(super) struct Line {
    pub from: PortRef,
    pub to: End,
    pub history: bool,
    pub points: Vec<Point>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum End {
    Port(PortRef),
    Output(usize),
}

/// Something that has a place in a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Item {
    Pass(Handle<Pass>),
    Output(usize),
    /// What a port writes passes through this column.
    Through(PortRef, usize),
}

/// Lays out every pass of a graph, those that do not run too.
pub(super) fn layout(graph: &Graph) -> Layout {
    let mut columns = Columns::new(graph);
    columns.order();
    columns.place();
    columns.layout()
}

struct Columns<'a> {
    graph: &'a Graph,
    columns: Vec<Vec<Item>>,
    column_of: Table<Pass, usize>,
    ends: Vec<(PortRef, End, bool)>,
    /// Items in neighbouring columns that a line joins, from left to right.
    joined: Vec<(Item, Item)>,
    places: FxHashMap<Item, Rectangle>,
}

impl<'a> Columns<'a> {
    fn new(graph: &'a Graph) -> Self {
        let ends = ends(graph);
        let column_of = depths(graph, &ends);
        let last = column_of.iter().max().map_or(0, |deepest| deepest + 1);
        let mut columns = vec![Vec::new(); last + 1];
        for (pass, column) in column_of.entries() {
            columns[*column].push(Item::Pass(pass));
        }
        let mut all = Self { graph, columns, column_of, ends, joined: Vec::new(), places: FxHashMap::default() };
        for output in 0..graph.outputs.len() {
            all.columns[last].push(Item::Output(output));
        }
        all.route();
        all
    }

    /// Gives every line that skips columns a place in each.
    fn route(&mut self) {
        let routed = self.column_of.len() <= MOST_ROUTED;
        for index in 0..self.ends.len() {
            let (from, to, history) = self.ends[index];
            if history {
                continue;
            }
            let mut before = Item::Pass(from.pass);
            let start = self.column_of[from.pass] + 1;
            for column in start..self.column(to).max(start) {
                let item = Item::Through(from, column);
                if routed && !self.columns[column].contains(&item) {
                    self.columns[column].push(item);
                }
                if routed {
                    self.join(before, item);
                    before = item;
                }
            }
            let end = match to {
                End::Port(port) => Item::Pass(port.pass),
                End::Output(output) => Item::Output(output),
            };
            self.join(before, end);
        }
    }

    fn join(&mut self, left: Item, right: Item) {
        if self.joined.last() != Some(&(left, right)) {
            self.joined.push((left, right));
        }
    }

    fn column(&self, end: End) -> usize {
        match end {
            End::Port(port) => self.column_of[port.pass],
            End::Output(_) => self.columns.len() - 1,
        }
    }

    /// Sorts each column by the average place of its neighbours, to and fro.
    fn order(&mut self) {
        for sweep in 0..SWEEPS {
            let mut rank: FxHashMap<Item, f64> = FxHashMap::default();
            for column in &self.columns {
                let half = (column.len() as f64 - 1.0) / 2.0;
                rank.extend(column.iter().enumerate().map(|(index, item)| (*item, index as f64 - half)));
            }
            let to_right = sweep % 2 == 0;
            let neighbours = self.neighbours(to_right);
            let count = self.columns.len();
            for step in 0..count {
                let column = if to_right { step } else { count - 1 - step };
                let mut items = std::mem::take(&mut self.columns[column]);
                let key = |item: &Item| average(neighbours.get(item), |other| rank[other]).unwrap_or(rank[item]);
                let keys: FxHashMap<Item, f64> = items.iter().map(|item| (*item, key(item))).collect();
                items.sort_by(|a, b| keys[a].total_cmp(&keys[b]));
                let half = (items.len() as f64 - 1.0) / 2.0;
                rank.extend(items.iter().enumerate().map(|(index, item)| (*item, index as f64 - half)));
                self.columns[column] = items;
            }
        }
    }

    /// By item, its neighbours on one side.
    fn neighbours(&self, on_left: bool) -> FxHashMap<Item, Vec<Item>> {
        let mut neighbours: FxHashMap<Item, Vec<Item>> = FxHashMap::default();
        for (left, right) in &self.joined {
            let (item, other) = if on_left { (right, left) } else { (left, right) };
            neighbours.entry(*item).or_default().push(*other);
        }
        neighbours
    }

    /// Gives every item a rectangle: columns side by side, and in each as near to the neighbours as the order allows.
    fn place(&mut self) {
        let mut x = ROW_GAP;
        for column in 0..self.columns.len() {
            let sizes: Vec<Point> = self.columns[column].iter().map(|item| self.item_size(*item)).collect();
            let width = sizes.iter().map(|size| size.0).fold(0.0, f64::max);
            let mut y = 0.0;
            for (item, size) in self.columns[column].iter().zip(sizes) {
                let width = if matches!(item, Item::Through(..)) { width } else { size.0 };
                self.places.insert(*item, Rectangle { x, y, width, height: size.1 });
                y += size.1 + ROW_GAP;
            }
            x += width + COLUMN_GAP;
        }
        for sweep in 0..SWEEPS {
            let neighbours = self.neighbours(sweep % 2 == 0);
            for column in 0..self.columns.len() {
                self.pull(column, &neighbours);
            }
        }
        let top = self.places.values().map(|place| place.y).fold(f64::MAX, f64::min);
        for place in self.places.values_mut() {
            place.y += ROW_GAP - top;
        }
    }

    fn pull(&mut self, column: usize, neighbours: &FxHashMap<Item, Vec<Item>>) {
        let mut floor = f64::MIN;
        let mut moved = 0.0;
        let items = &self.columns[column];
        for item in items {
            let place = self.places[item];
            let middle = |other: &Item| self.places[other].y + self.places[other].height / 2.0;
            let wanted = average(neighbours.get(item), middle).map_or(place.y, |middle| middle - place.height / 2.0);
            let y = wanted.max(floor);
            moved += y - wanted;
            floor = y + place.height + ROW_GAP;
            if let Some(place) = self.places.get_mut(item) {
                place.y = y;
            }
        }
        // What was pushed down moves up again by half, as a block.
        let lift = moved / items.len().max(1) as f64;
        for item in items {
            if let Some(place) = self.places.get_mut(item) {
                place.y -= lift;
            }
        }
    }

    fn item_size(&self, item: Item) -> Point {
        match item {
            Item::Pass(pass) => box_size(self.graph, pass),
            Item::Output(output) => (text_width(&self.graph.outputs[output].0) + 28.0, 26.0),
            Item::Through(..) => (0.0, 6.0),
        }
    }

    fn layout(self) -> Layout {
        let place = |item: Item| self.places.get(&item).copied().unwrap_or_default();
        let boxes: Table<Pass, Rectangle> = self.column_of.handles().map(|pass| place(Item::Pass(pass))).collect();
        let tags: Vec<Rectangle> = (0..self.graph.outputs.len()).map(|output| place(Item::Output(output))).collect();
        let lines = self.ends.iter().map(|(from, to, history)| {
            let mut points = vec![pin(self.graph, &boxes, *from, true)];
            for column in self.column_of[from.pass] + 1..self.column(*to) {
                if let (Some(place), false) = (self.places.get(&Item::Through(*from, column)), *history) {
                    points.extend([(place.x, place.y + 3.0), (place.x + place.width, place.y + 3.0)]);
                }
            }
            points.push(match to {
                End::Port(port) => pin(self.graph, &boxes, *port, false),
                End::Output(output) => (tags[*output].x, tags[*output].y + tags[*output].height / 2.0),
            });
            Line { from: *from, to: *to, history: *history, points }
        });
        let lines = lines.collect();
        let edge = |extent: fn(&Rectangle) -> f64| self.places.values().map(extent).fold(0.0, f64::max) + ROW_GAP;
        let size = (edge(|place| place.x + place.width), edge(|place| place.y + place.height));
        Layout { boxes, tags, lines, size }
    }
}

/// Every connection and output, in file order.
fn ends(graph: &Graph) -> Vec<(PortRef, End, bool)> {
    let connections = graph.connections.iter();
    let connections = connections.map(|connection| (connection.from, End::Port(connection.to), connection.history));
    let outputs = graph.outputs.iter().enumerate().map(|(index, (_, from))| (*from, End::Output(index), false));
    connections.chain(outputs).collect()
}

/// By pass, its column: one behind the deepest that it reads; what reads nothing stands before its first reader.
fn depths(graph: &Graph, ends: &[(PortRef, End, bool)]) -> Table<Pass, usize> {
    let mut read_by: Table<Pass, Vec<Handle<Pass>>> = graph.passes.column(Vec::new());
    let mut reads = graph.passes.column(false);
    for (from, to, history) in ends {
        if let (End::Port(to), false) = (to, *history) {
            read_by[from.pass].push(to.pass);
            reads[to.pass] = true;
        }
    }
    let mut depths: Table<Pass, usize> = graph.passes.column(0);
    for pass in &graph.wiring.order {
        for reader in &read_by[*pass] {
            depths[*reader] = depths[*reader].max(depths[*pass] + 1);
        }
    }
    for pass in graph.passes.handles() {
        let nearest = read_by[pass].iter().map(|reader| depths[*reader]).min();
        if let (false, Some(nearest)) = (reads[pass], nearest) {
            depths[pass] = nearest - 1;
        }
    }
    depths
}

fn average<T>(items: Option<&Vec<T>>, value: impl Fn(&T) -> f64) -> Option<f64> {
    let items = items.filter(|items| !items.is_empty())?;
    Some(items.iter().map(value).sum::<f64>() / items.len() as f64)
}

fn box_size(graph: &Graph, pass: Handle<Pass>) -> Point {
    let descriptor = graph.pass(pass).descriptor();
    let column = |wanted: fn(&crate::descriptor::Role) -> bool| {
        let names = descriptor.ports.iter().filter(|port| wanted(&port.role)).map(|port| text_width(&port.name));
        (names.clone().fold(0.0, f64::max), names.count() as f64)
    };
    let ((left, inputs), (right, outputs)) = (column(|role| role.is_input()), column(|role| role.is_output()));
    let title = text_width(&graph.pass(pass).name) * 1.15 + 44.0;
    let width = (left + right + 76.0).max(title).max(text_width(&descriptor.name) + 28.0);
    (width, HEADER + LINE * inputs.max(outputs) + 8.0)
}

/// Where a line meets a box.
fn pin(graph: &Graph, boxes: &Table<Pass, Rectangle>, port: PortRef, output: bool) -> Point {
    let place = boxes[port.pass];
    (if output { place.x + place.width } else { place.x }, place.y + line_middle(row(graph, port, output)))
}

/// Which line of its side of the box a port has.
pub(super) fn row(graph: &Graph, port: PortRef, output: bool) -> usize {
    let ports = &graph.wiring.passes.kind(port.pass).signature.ports;
    let on_side = |role: RoleKind| if output { role.is_output() } else { role.is_input() };
    ports.iter().take(port.port.index()).filter(|port| on_side(port.role)).count()
}

/// Height of the middle of a port's line below the top of its box.
pub(super) fn line_middle(row: usize) -> f64 {
    HEADER + LINE * (row as f64 + 0.5)
}

/// About how wide a text is, 12 pixels high.
pub(super) fn text_width(text: &str) -> f64 {
    7.3 * text.chars().count() as f64
}
