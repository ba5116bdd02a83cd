//! The twins of Hong's tables against numbers that were computed outside the project (NumPy, SciPy, mpmath).

use serde_json::Value;
use tyndall_shaders::airlight_table::{h, h_k};
use tyndall_shaders::scene::Phase;
use tyndall_shaders::surface_table::{j, j_k};

fn data() -> Value {
    serde_json::from_str(include_str!("data/tables.json")).expect("the file is JSON")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn list<'a>(data: &'a Value, name: &str) -> &'a Vec<Value> {
    data[name].as_array().expect("a list")
}

#[test]
fn h_of_terms() {
    let data = data();
    assert_eq!(list(&data, "H_k").len(), 100);
    for point in list(&data, "H_k") {
        let values = h_k(number(&point["u"]), number(&point["v"]));
        for (value, expected) in values.iter().zip(point["H_k"].as_array().expect("a list")) {
            assert!((value - number(expected)).abs() < 1e-10, "{point}: {values:?}");
        }
    }
}

#[test]
fn h_of_phase_functions() {
    let data = data();
    assert_eq!(list(&data, "H").len(), 20);
    for point in list(&data, "H") {
        for g in [0.0, 0.5, 0.9] {
            let value = h(&Phase::HenyeyGreenstein { g }, number(&point["u"]), number(&point["v"]));
            let expected = number(&point[format!("H_hg{g:.1}")]);
            assert!((value / expected - 1.0).abs() < 1e-9, "{point}, g {g}: {value}");
        }
    }
}

/// The file is good to 2e-10 of the isotropic value.
#[test]
fn j_of_phase_functions_and_terms() {
    let data = data();
    assert_eq!(list(&data, "J").len(), 24);
    for row in list(&data, "J") {
        let row: Vec<f64> = row.as_array().expect("a list").iter().map(number).collect();
        let (n, depth, angle) = (row[0], row[1], row[2].to_radians());
        let of = |g| j(&Phase::HenyeyGreenstein { g }, n, depth, angle);
        let values = [of(0.0), of(0.5), of(0.9)].into_iter().chain(j_k(n, depth, angle));
        for (i, value) in values.enumerate() {
            let scale = if i < 3 { row[3].max(row[3 + i]) } else { row[6] };
            assert!((value - row[3 + i]).abs() < 2e-8 * scale, "{row:?}: {value} is number {i}");
        }
    }
}
