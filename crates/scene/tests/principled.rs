//! Metallic-roughness materials against Mitsuba's `principled`: what `microfacets` says of the error.
//!
//! The figures stand in `reference/principled.csv`, which `reference/principled.py` made beside it.

use std::f64::consts::PI;

use tyndall_scene::microfacets::{DIELECTRIC, Lobe};

/// A material seen from one side, with the light that it reflects, in the mean of the three channels.
struct Seen {
    name: String,
    base: [f64; 3],
    metallic: f64,
    roughness: f64,
    /// Radians.
    view: f64,
    lights: Vec<[f64; 6]>,
}

fn reference() -> Vec<Seen> {
    let mut seen: Vec<Seen> = Vec::new();
    for line in include_str!("reference/principled.csv").lines().filter(|line| !line.starts_with('#')) {
        let words: Vec<&str> = line.split(',').collect();
        let number = |at: usize| words[at].parse::<f64>().expect("a number");
        match (words.len(), seen.last_mut()) {
            (7, _) => seen.push(Seen {
                name: words[0].to_owned(),
                base: [1, 2, 3].map(number),
                metallic: number(4),
                roughness: number(5),
                view: number(6).to_radians(),
                lights: Vec::new(),
            }),
            (6, Some(last)) => last.lights.push([0, 1, 2, 3, 4, 5].map(number)),
            _ => panic!("{line}"),
        }
    }
    seen
}

/// ρ and k_s of each channel.
fn reflectances(seen: &Seen, lobe: &Lobe) -> [(f64, f64); 3] {
    seen.base.map(|base| {
        let rho = base * (1.0 - seen.metallic);
        let mirrored = DIELECTRIC * (1.0 - seen.metallic) + base * seen.metallic;
        (rho, (mirrored * lobe.peak).min(lobe.most * (1.0 - rho)))
    })
}

/// Of the mean of three channels: the peak and the sum over all lights, of Mitsuba and here, and how much of the former goes
/// in other directions.
struct Figures {
    peak: [f64; 2],
    all: [f64; 2],
    elsewhere: f64,
}

fn figures(seen: &Seen) -> Figures {
    let lobe = Lobe::of_roughness(seen.roughness);
    let channels = reflectances(seen, &lobe);
    let (mut all, mut elsewhere) = ([0.0; 2], 0.0);
    for [alpha, azimuth, solid, truth @ ..] in &seen.lights {
        // The mirrored ray leans by the angle of the view; azimuth 0 leans further.
        let facing = alpha.cos() * seen.view.cos() - alpha.sin() * azimuth.cos() * seen.view.sin();
        let phong = if alpha.cos() > 0.0 { alpha.cos().powf(lobe.shininess) } else { 0.0 };
        for ((rho, k_s), truth) in channels.iter().zip(truth) {
            let here = rho / PI * facing + k_s * phong;
            all[0] += truth * solid / 3.0;
            all[1] += here * solid / 3.0;
            elsewhere += (here - truth).abs() * solid / 3.0;
        }
    }
    let peak = seen.lights[0][3..].iter().sum::<f64>() / 3.0;
    let here = channels.iter().map(|(rho, k_s)| rho / PI * seen.view.cos() + k_s).sum::<f64>() / 3.0;
    Figures { peak: [peak, here], all, elsewhere: elsewhere / all[0] }
}

#[test]
fn lobes_are_those_of_microfacets() {
    let reference = reference();
    assert_eq!(reference.len(), 30);
    for seen in &reference {
        let Figures { peak, all, elsewhere } = figures(seen);
        let view = seen.view.to_degrees().round();
        let line = format!("{} at {view}°: peak {peak:.3?}, all {all:.3?}, elsewhere {elsewhere:.3}", seen.name);
        println!("{line}");
        let ratio = |[truth, here]: [f64; 2]| here / truth;
        let (least, most) = if view == 60.0 {
            (0.22, 1.0)
        } else if view == 30.0 {
            (0.8, 1.0)
        } else {
            (0.985, 1.015)
        };
        assert!(ratio(peak) > least && ratio(peak) < most, "{line}");
        if view < 60.0 {
            let off = (all[1] - all[0]).abs();
            assert!(if seen.roughness > 0.8 { off < 0.11 } else { off < 0.09 * all[0] }, "{line}");
            assert!(elsewhere < if seen.metallic > 0.0 { 0.42 } else { 0.25 }, "{line}");
        }
    }
}

#[test]
fn no_more_light_leaves_than_arrives() {
    let unit = |i: u32| f64::from(i) / 20.0;
    for (base, metallic, roughness) in
        (0..=20).flat_map(|b| (0..=20).flat_map(move |m| (0..=20).map(move |r| (unit(b), unit(m), unit(r)))))
    {
        let lobe = Lobe::of_roughness(roughness);
        let seen = Seen { name: String::new(), base: [base; 3], metallic, roughness, view: 0.0, lights: Vec::new() };
        let [(rho, k_s), ..] = reflectances(&seen, &lobe);
        let all = rho + k_s * 2.0 * PI / (lobe.shininess + 1.0);
        assert!(all <= 1.0 + 1e-12 && k_s >= 0.0, "{base} {metallic} {roughness}: {all}");
    }
    // What is rougher has a wider and a fainter lobe.
    let lobes: Vec<Lobe> = (0..=20).map(|i| Lobe::of_roughness(unit(i))).collect();
    assert!(lobes.windows(2).all(|pair| pair[1].shininess <= pair[0].shininess && pair[1].peak <= pair[0].peak));
    assert_eq!((lobes[20].shininess, lobes[20].peak), (0.0, 0.25 / PI));
}
