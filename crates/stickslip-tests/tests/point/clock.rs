//! Time without drift.

use stickslip::integrate::Clock;

#[test]
fn constant_steps_do_not_accumulate_rounding() {
    let mut clock = Clock::default();
    for _ in 0..6735 {
        clock = clock.after(1.5e-3);
    }
    assert_eq!(clock.time(), 6735.0 * 1.5e-3);
    assert_eq!(clock.step(), 6735);
}

#[test]
fn what_is_left_leads_to_the_time_asked_for() {
    let mut clock = Clock::default();
    for n in 0..10_000_usize {
        let until = clock.time() + 1.7_f64.powi((n % 40) as i32 - 20);
        assert_eq!(clock.after(clock.left(until)).time(), until);
        clock = clock.after(0.1 + 0.7 * (n % 7) as f64);
    }
}

#[test]
fn changing_steps_lose_nothing() {
    let mut clock = Clock::default();
    for n in 0..1_000_000_usize {
        clock = clock.after(if n % 2 == 0 { 0.1 } else { 1e-9 });
    }
    let exact = 500_000.0 * 0.1 + 500_000.0 * 1e-9;
    assert!(
        (clock.time() - exact).abs() <= 1e-11,
        "{}",
        clock.time() - exact
    );
}
