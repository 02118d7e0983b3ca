//! Size laws against their formulas, and loads against their shares: to one disc, however few there are.

use drumrs::physics::load::composition::{Composition, SpeciesParameters};
use drumrs::physics::load::formulas::{CUT, Formula};
use drumrs::physics::load::shares::Measure;
use drumrs::physics::load::sizes::{SizeDistribution, SizeLaw};
use rand::SeedableRng;
use rand_pcg::Pcg64;

const MANY: usize = 100_000;

fn law(by: Measure, formula: Formula, smallest: Option<f64>, largest: Option<f64>) -> SizeLaw {
    SizeLaw::Formula { by, formula, smallest, largest }
}

fn gaudin(by: Measure, modulus: f64, smallest: Option<f64>) -> SizeLaw {
    law(by, Formula::GaudinSchuhmann { top_size: 0.1, modulus }, smallest, None)
}

fn distribution(law: &SizeLaw) -> SizeDistribution {
    law.distribution("sizes").expect("a valid law")
}

fn drawn(law: &SizeLaw, count: usize, seed: u64) -> Vec<f64> {
    distribution(law).diameters(count, &mut Pcg64::seed_from_u64(seed))
}

/// The share, by a measure, of the discs that are smaller than `diameter`.
fn share_below(diameters: &[f64], by: Measure, diameter: f64) -> f64 {
    let weight = |d: &f64| if by == Measure::Number { 1.0 } else { d * d };
    let all: f64 = diameters.iter().map(weight).sum();
    diameters.iter().filter(|&&d| d < diameter).map(weight).sum::<f64>() / all
}

/// Each formula, written out anew, between its ends.
fn formulas() -> Vec<(Formula, Option<f64>, Box<dyn Fn(f64) -> f64>)> {
    let normal = |z: f64| 0.5 * (1.0 + libm::erf(z / 2.0_f64.sqrt()));
    vec![
        (
            Formula::GaudinSchuhmann { top_size: 0.1, modulus: 0.6 },
            Some(0.02),
            Box::new(|d: f64| (d / 0.1).powf(0.6)),
        ),
        (
            Formula::RosinRammler { size_63: 0.05, modulus: 1.4 },
            Some(0.01),
            Box::new(|d: f64| 1.0 - (-(d / 0.05).powf(1.4)).exp()),
        ),
        (
            Formula::Lognormal { median: 0.03, sigma: 0.4 },
            None,
            Box::new(move |d: f64| normal((d / 0.03).ln() / 0.4)),
        ),
        (
            Formula::Normal { mean: 0.03, sigma: 0.005 },
            None,
            Box::new(move |d: f64| normal((d - 0.03) / 0.005)),
        ),
    ]
}

#[test]
fn shares_are_those_of_the_formula() {
    for by in [Measure::Mass, Measure::Area, Measure::Number] {
        for (formula, smallest, below) in formulas() {
            let diameters = drawn(&law(by, formula, smallest, None), MANY, 1);
            let (first, last) = (diameters[0], diameters[MANY - 1]);
            let (start, end) = (smallest.unwrap_or(formula.ends().0), formula.ends().1);
            assert!(start <= first && last <= end);
            for k in 1..8 {
                let d = start + (end - start) * f64::from(k) / 8.0;
                let expected = (below(d) - below(start)) / (below(end) - below(start));
                let error = share_below(&diameters, by, d) - expected;
                assert!(error.abs() < 2e-4, "{formula:?} by {by:?} below {d}: off by {error:.1e}");
            }
        }
    }
}

/// In two dimensions, F₀(d) = (d^(m−2) − a^(m−2)) / (k^(m−2) − a^(m−2)), a logarithm at m = 2; 1/⟨d²⟩ is its integral.
#[test]
fn numbers_go_as_mass_over_the_square() {
    let (a, k) = (0.01_f64, 0.1_f64);
    for m in [0.5, 1.0, 2.0, 3.5] {
        let law = gaudin(Measure::Mass, m, Some(a));
        let diameters = drawn(&law, MANY, 2);
        let power = |d: f64| if m == 2.0 { d.ln() } else { d.powf(m - 2.0) / (m - 2.0) };
        for d in [0.011, 0.02, 0.05, 0.09] {
            let expected = (power(d) - power(a)) / (power(k) - power(a));
            assert!(
                (share_below(&diameters, Measure::Number, d) - expected).abs() < 1e-4,
                "m = {m}, d = {d}"
            );
        }
        let inverse = m * (power(k) - power(a)) / (k.powf(m) - a.powf(m));
        assert!((distribution(&law).mean_square() * inverse - 1.0).abs() < 1e-6, "m = {m}");
        let drawn: f64 = diameters.iter().map(|d| d * d).sum::<f64>() / MANY as f64;
        assert!((drawn * inverse - 1.0).abs() < 1e-4, "m = {m}");
    }
}

/// A lognormal law by mass is one by number whose median is exp(−2σ²) times as large.
#[test]
fn medians_by_mass_and_by_number_differ() {
    let formula = Formula::Lognormal { median: 0.03, sigma: 0.4 };
    let diameters = drawn(&law(Measure::Mass, formula, Some(1e-3), Some(0.9)), MANY, 3);
    let median = diameters[MANY / 2];
    assert!((median / (0.03 * (-0.32_f64).exp()) - 1.0).abs() < 1e-3, "{median}");
}

#[test]
fn a_hundred_discs_obey_the_law_to_one_of_them() {
    for (formula, smallest, below) in formulas() {
        let law = law(Measure::Mass, formula, smallest, None);
        for seed in 0..20 {
            let diameters = drawn(&law, 100, seed);
            let all: f64 = diameters.iter().map(|d| d * d).sum();
            let (start, end) = (smallest.unwrap_or(formula.ends().0), formula.ends().1);
            for d in diameters.iter().step_by(10) {
                let expected = (below(*d) - below(start)) / (below(end) - below(start));
                let largest = diameters[99] * diameters[99] / all;
                let error = share_below(&diameters, Measure::Mass, *d) - expected;
                assert!(error.abs() < largest, "{formula:?}, seed {seed}, {d}: {error} of {largest}");
            }
        }
    }
}

#[test]
fn a_table_is_met_between_its_entries_too() {
    let law = SizeLaw::Table {
        by: Measure::Mass,
        diameters: vec![0.01, 0.02, 0.05, 0.06],
        passing: vec![0.0, 0.3, 0.3, 1.0],
    };
    let diameters = drawn(&law, MANY, 4);
    for (d, passing) in [(0.015, 0.15), (0.02, 0.3), (0.04, 0.3), (0.055, 0.65)] {
        assert!((share_below(&diameters, Measure::Mass, d) - passing).abs() < 1e-4, "{d}");
    }
    assert!(
        diameters.iter().all(|d| !(0.0201..0.0499).contains(d)),
        "nothing lies where nothing is retained"
    );
}

#[test]
fn a_mix_has_whole_numbers() {
    let law = |by| SizeLaw::Mix { by, diameters: vec![0.03, 0.01], shares: vec![0.9, 0.1] };
    let small = |diameters: Vec<f64>| diameters.iter().filter(|&&d| d == 0.01).count();
    assert_eq!(small(drawn(&law(Measure::Number), 10, 1)), 1);
    assert_eq!(small(drawn(&law(Measure::Mass), 10, 1)), 5);
    assert_eq!(small(drawn(&law(Measure::Area), 100, 1)), 50);
}

#[test]
fn seeds_give_the_same_bits() {
    let law = gaudin(Measure::Mass, 0.6, Some(0.01));
    assert_eq!(drawn(&law, 1000, 7), drawn(&law, 1000, 7));
    assert_ne!(drawn(&law, 1000, 7), drawn(&law, 1000, 8));
}

#[test]
fn what_has_no_end_is_cut_off() {
    let width = 3.090_232_306_167_813_5;
    for formula in formulas().into_iter().map(|(formula, ..)| formula) {
        let (first, last) = formula.ends();
        assert!((formula.below(first) / CUT - 1.0).abs() < 1e-9, "{formula:?}");
        let above = if matches!(formula, Formula::GaudinSchuhmann { .. }) { 0.0 } else { CUT };
        assert!((1.0 - formula.below(last) - above).abs() < 1e-12, "{formula:?}");
    }
    assert_eq!(Formula::Normal { mean: 1.0, sigma: 0.1 }.ends(), (1.0 - 0.1 * width, 1.0 + 0.1 * width));
}

fn refusal(law: &SizeLaw) -> String {
    law.distribution("load.species[0].sizes").expect_err("a bad law").to_string()
}

#[test]
fn bad_laws_are_refused_by_name() {
    let table = |diameters: &[f64], passing: &[f64]| SizeLaw::Table {
        by: Measure::Mass,
        diameters: diameters.to_vec(),
        passing: passing.to_vec(),
    };
    let mix = |diameters: &[f64], shares: &[f64]| SizeLaw::Mix {
        by: Measure::Mass,
        diameters: diameters.to_vec(),
        shares: shares.to_vec(),
    };
    let normal = Formula::Normal { mean: 0.01, sigma: 0.005 };
    let cases = [
        (
            gaudin(Measure::Mass, 1.5, None),
            "smallest is missing, but must be given where the modulus is at most 2, here 1.5: the number of discs goes as mass/d² and has no bound towards small ones",
        ),
        (
            gaudin(Measure::Mass, 1.0, Some(0.2)),
            "largest is 0.1, but must be a finite number above the smallest, 0.2",
        ),
        (gaudin(Measure::Number, -1.0, None), "modulus is -1, but must be a positive finite number"),
        (
            law(Measure::Mass, normal, None, None),
            "smallest is missing and would be -0.0055, but must be a positive finite number; where it is missing, 0.001 of all is smaller",
        ),
        (
            table(&[0.01, 0.02], &[1.0, 0.0]),
            "passing[1] is 0, but must be at least the one before it, 1: what passes a sieve, not what it retains",
        ),
        (
            table(&[0.02, 0.01], &[0.0, 1.0]),
            "diameters[1] is 0.01, but must be a finite number above the one before it, 0.02",
        ),
        (
            table(&[0.01, 0.02], &[0.1, 1.0]),
            "passing[0] is 0.1, but must be 0, at a diameter that nothing is smaller than",
        ),
        (
            table(&[0.01, 0.02], &[0.0, 90.0]),
            "passing[1] is 90, but must be 1, at a diameter that all is smaller than",
        ),
        (
            table(&[0.01, 0.02], &[0.0]),
            "passing is of length 1, but must be of length 2, as load.species[0].sizes.diameters is",
        ),
        (mix(&[0.01, 0.02], &[0.5, 0.4]), "shares is 0.9 in all, but must be 1 in all"),
        (mix(&[0.01, 0.02], &[50.0, 50.0]), "shares is 100 in all, but must be 1 in all: 20 % is 0.2"),
        (mix(&[0.01, -0.02], &[0.5, 0.5]), "diameters[1] is -0.02, but must be a positive finite number"),
    ];
    for (law, sentence) in cases {
        assert_eq!(refusal(&law), format!("load.species[0].sizes.{sentence}"));
    }
}

fn two(share_by: Measure) -> Composition {
    let steel = SpeciesParameters { share: 0.25, density: 7800.0, sizes: SizeLaw::equal(0.02) };
    let sizes = gaudin(Measure::Mass, 0.6, Some(0.01));
    Composition::new(&[steel, SpeciesParameters { share: 0.75, density: 2700.0, sizes }], share_by)
        .expect("valid species")
}

#[test]
fn shares_of_species_are_met_to_one_disc() {
    for share_by in [Measure::Mass, Measure::Area, Measure::Number] {
        let discs = two(share_by).discs(400, 3).expect("enough discs");
        let weight = |species: u16, radius: f64| match share_by {
            Measure::Number => 1.0,
            Measure::Area => radius * radius,
            Measure::Mass => radius * radius * [7800.0, 2700.0][usize::from(species)],
        };
        let each =
            || discs.species.iter().zip(&discs.radii).map(|(&own, &radius)| (own, weight(own, radius)));
        let of = |species: u16| each().filter(move |disc| disc.0 == species).map(|disc| disc.1);
        let (steel, all): (f64, f64) = (of(0).sum(), each().map(|disc| disc.1).sum());
        let largest = of(0).chain(of(1)).fold(0.0, f64::max);
        assert!((steel - 0.25 * all).abs() < largest, "{share_by:?}: {steel} of {all}");
    }
}

/// Mean area and mass say how many discs a fill or a mass takes.
#[test]
fn means_are_those_of_the_discs() {
    let composition = two(Measure::Mass);
    let discs = composition.discs(20_000, 1).expect("enough discs");
    let areas = discs.radii.iter().map(|radius| std::f64::consts::PI * radius * radius);
    let density = |species: &u16| [7800.0, 2700.0][usize::from(*species)];
    let mass: f64 = areas.clone().zip(&discs.species).map(|(area, own)| area * density(own)).sum();
    let area: f64 = areas.sum();
    assert!((area / 20_000.0 / composition.mean_area - 1.0).abs() < 1e-3);
    assert!((mass / 20_000.0 / composition.mean_mass - 1.0).abs() < 1e-3);
}

/// Species lie mixed, however many there are of each, and another seed mixes them otherwise.
#[test]
fn species_are_shuffled() {
    let discs = |seed| two(Measure::Number).discs(1000, seed).expect("enough discs").species;
    let early = discs(1).iter().take(500).filter(|&&own| own == 0).count();
    assert!((90..160).contains(&early), "{early} of 250 among the first half");
    assert_eq!(discs(1), discs(1));
    assert_ne!(discs(1), discs(2));
}

#[test]
fn bad_shares_are_refused_by_name() {
    let species = |shares: [f64; 2]| {
        shares.map(|share| SpeciesParameters { share, density: 1.0, sizes: SizeLaw::equal(0.01) })
    };
    let refused =
        |shares| Composition::new(&species(shares), Measure::Mass).expect_err("bad shares").to_string();
    assert_eq!(refused([0.5, 0.4]), "the share of load.species is 0.9 in all, but must be 1 in all");
    assert_eq!(refused([1.5, -0.5]), "load.species[1].share is -0.5, but must be a positive finite number");
    let few = Composition::new(&species([0.999, 0.001]), Measure::Number).expect("valid shares");
    assert_eq!(
        few.discs(100, 1).expect_err("none of the second").to_string(),
        "load.species[1].share is 1.000e-3 of the number, but must be enough for one of 100 bundles: raise it, or the amount of the load"
    );
}
