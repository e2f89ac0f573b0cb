"""Slips of students that no single sign, number or letter mends: the correction is that of a tutor, and is said as one."""

from __future__ import annotations

from books import Book
from store import every

from freebody.check.file import judged_alone

SLIPS = {
    "a ratio upside down": ("gears_and_drum", "ω_B = R/r ω", "ω_B = r/R ω", "upside down"),
    "a ratio that counts twice": (
        "gears_and_drum",
        "Q + m g d r/R = (I_A + (I_B + m d²) r/R) α",
        "Q + m g d r/R = (I_A + (I_B + m d²) r²/R²) α",
        "counts twice",
    ),
    "two terms with one factor": (
        "gears_and_drum",
        "Q + m g d r/R = (I_A + I_B + m d²) α",
        "Q + m g d r/R = (I_A + (I_B + m d²) r²/R²) α",
        "a factor is forgotten",
    ),
    "lost before it was differentiated": (
        "rod_on_cart",
        "P ẋ = d/dt(½ (M + m) ẋ² + 1/6 m L² θ̇² − ½ m g L cos θ)",
        "P ẋ = d/dt(½ (M + m) ẋ² + ½ m L ẋ θ̇ cos θ + 1/6 m L² θ̇² − ½ m g L cos θ)",
        "is left out",
    ),
    "work of a couple": (
        "stepped_drum",
        "constant: ½ I ω² + ½ mA vA² + ½ mB vB² + mA g yA − mB g yB",
        "constant: ½ I ω² + ½ mA vA² + ½ mB vB² + mA g yA − mB g yB + C θ",
        "is left out",
    ),
    "speed beside what moves": (
        "disk_along_a_turning_wall",
        "T = ½ m ((x' − Ω r)² + Ω² x²) + ¼ m x'² + ½ J Ω²",
        "T = ½ m ((x' − Ω r)² + Ω² x²) + ¼ m (x' − r Ω)² + ½ J Ω²",
        "another quantity",
    ),
    "weight for what presses": ("sliding_door", "P − μ m g = m a", "P − μ N_A = m a", "another quantity"),
    "a number in a limit": ("disk_drawn_by_block", "as mB -> inf: α = g/(3 R)", "as mB -> inf: α = 2 g/(3 R)", "a number"),
    "one instant": (
        "ball_strikes_a_free_bar",
        "just after: V = m (1 + e) v0/(M + m)",
        "just after: V = m (1 + e) v0/(M + m + 12 m d²/L²)",
        "is left out",
    ),
    "stretch of the whole length": (
        "slingshot_bands",
        "T + V = const: ½ m v² + ½ (k_1 + k_2)(x² + a²) = const",
        "½ m v² + ½ (k_1 + k_2)(√(x² + a²) − l_0)² = const",
        "another quantity",
    ),
    "speed on what moves": (
        "ship_with_moving_weight",
        "if c = 0: ½ I_O φ'² + ½ m s'² − M g a cos φ + m g (s sin φ + h cos φ) + ½ k s² = const",
        "if c = 0: ½ I_O φ'² + ½ m [(s' − h φ')² + s² φ'²] − M g a cos φ + m g (s sin φ + h cos φ) + ½ k s² = const",
        "is left out",
    ),
    "energy for momentum": (
        "skater_draws_in_arms",
        "½ (J + 2 m r²) θ'² = const",
        "(J + 2 m r²) θ' = const",
        "the power is another",
    ),
    "no constant": (
        "child_pumps_swing",
        "constant: ½ m (r'² + r² θ'²) − m g r cos θ",
        "d/dt(½ m (r'² + r² θ'²) − m g r cos θ) = −T r'",
        "that changes it",
    ),
    "one of two alike": (
        "skater_draws_in_arms",
        "(J + m r²) ω = (J + m r_0²) ω_0",
        "(J + 2 m r²) ω = (J + 2 m r_0²) ω_0",
        "throughout",
    ),
    "what is below a root": (
        "superball_bounce",
        "just after the impact: v_y = e √(2 g h)",
        "just after the impact: v_y = e √(2 g (h − R))",
        "another quantity",
    ),
    "an angle of the start": (
        "curling_stones",
        "just after the impact: (x_B' − x_A') cos β + (y_B' − y_A') sin β = e v_0",
        "just after the impact: (x_B' − x_A') cos β + (y_B' − y_A') sin β = e v_0 cos β",
        "a factor is forgotten",
    ),
    "after a long time": ("fluid_coupling", "as t → ∞: θ1' − θ2' → T/b", "as t → ∞: θ1' − θ2' → T/c", "another quantity"),
    "small lengths": (
        "slingshot_bands",
        "for small x: m x'' + (k_1 + k_2) x = 0",
        "for small x: m x'' + (k_1 + k_2)(1 − l_0/a) x = 0",
        "is left out",
    ),
    "at an event": (
        "disc_clutch",
        "when the clutch grips: ½ J_1 ω_1² + ½ J_2 ω_2² = J_1 ω_0²/(2 (J_1 + J_2))",
        "when the clutch grips: ½ J_1 ω_1² + ½ J_2 ω_2² = J_1² ω_0²/(2 (J_1 + J_2))",
        "a factor is forgotten",
    ),
    "both parts of an acceleration": (
        "two_rotor_drone",
        "l φ'' + g sin φ = 0",
        "l φ'' + x'' cos φ + y'' sin φ + g sin φ = 0",
        "is left out",
    ),
    "differentiated by half": (
        "ice_yacht",
        "y'' cos ψ − x'' sin ψ = 0",
        "y'' cos ψ − x'' sin ψ − ψ' (x' cos ψ + y' sin ψ) = 0",
        "is left out",
    ),
    "a letter of the model": ("collar_and_counterweight", "z' = −y'", "z' = −y y'/s", "a factor is forgotten"),
    "behind a label": (
        "bungee_jumper",
        "↓ cord taut: m g − k x = m x''",
        "once the cord is taut: m g − k (x − l) = m x''",
        "is left out",
    ),
    "part of a vector": (
        "plate_on_parallel_links",
        "a_G = r θ̈ (−sin θ i + cos θ j)",
        "a_G = r θ̈ (−sin θ i + cos θ j) − r θ̇² (cos θ i + sin θ j)",
        "the centripetal part",
    ),
    "a place of rest": (
        "carpenters_square",
        "at rest: tan θ = −m_2 b/a",
        "at rest: m_1 tan θ = −m_2 b/a",
        "a factor is forgotten",
    ),
    "inertia beside a damper": ("fluid_coupling", "(b + c) θ2' = c θ1'", "J_2 θ2'' + (b + c) θ2' = c θ1'", "is left out"),
    "a coordinate of which nothing was said": (
        "roller_off_a_drum",
        "ΣF_n: −N = m v²/(R + r)",
        "ΣF_n: m g cos θ − N = m v²/(R + r)",
        "is left out",
    ),
    "a root": ("teeterboard", "just before he lands: y' = −2 g h", "just before he lands: y' = −√(2 g h)", "root"),
    "each wheel": (
        "wagons_with_buffer",
        "(M_1 + m) ẋ_1 + (M_2 + m) ẋ_2 = const",
        "(M_1 + m + J/r²) ẋ_1 + (M_2 + m + J/r²) ẋ_2 = const",
        "throughout",
    ),
    "what is 0 at the start": ("driver_on_sprung_seat", "at t = 0: x₂'' = c₂ Z Ω/m₂", "at t = 0: x₂'' = 0", "no place"),
    "a strand of a belt that drifts": (
        "elastic_belt",
        "ω_n² = k (r_1²/J_1 + r_2²/J_2)",
        "ω_n² = 2 k (r_1²/J_1 + r_2²/J_2)",
        "a number",
    ),
    "a letter for a sum": (
        "ship_with_moving_weight",
        "if c = 0: ½ I_O φ'² + ½ m (s'² + s² φ'²) − M g a cos φ + m g (s sin φ + h cos φ) + ½ k s² = const",
        "if c = 0: ½ I_O φ'² + ½ m [(s' − h φ')² + s² φ'²] − M g a cos φ + m g (s sin φ + h cos φ) + ½ k s² = const",
        "",
    ),
    "rotation left out everywhere": (
        "hoop_and_disk_linked",
        "½ (m_1 + m_2) x'² = (m_1 + m_2) g (x − x_0) sin β",
        "(m_1 + ¾ m_2) x'² = (m_1 + m_2) g (x − x_0) sin β",
        "kinetic energy",
    ),
    "moment of the force of a pin": (
        "saloon_door",
        "AMB/G: −κθ − cθ' = (1/12) m w² θ''",
        "AMB/G: (H_x sin θ − H_y cos θ) w/2 − κθ − cθ' = (1/12) m w² θ''",
        "a force or a moment",
    ),
    "speed with a letter": (
        "chaplygin_sleigh",
        "(J + m c²) θ'' = 0",
        "(J + m c²) θ'' + m c u θ' = 0",
        "is left out",
    ),
    "force of a neighbour by its letter": (
        "stacked_blocks_and_cord",
        "P − T − f_2 = m_B x''",
        "P − T − f_1 − f_2 = m_B x''",
        "a force",
    ),
    "one of several natural frequencies": (
        "swinging_spring",
        "small swings: ω = √(g/l_0)",
        "small swings: ω = √(g/(l_0 + m g/k))",
        "an arm",
    ),
    "a balance of two bodies has no force between them": (
        "lanchester_damper",
        "hub + ring, oil internal: J θ'' = T_0 sin Ωt − k θ",
        "hub + ring: J θ'' + J_d φ'' = T_0 sin Ωt − k θ",
        "moves as well",
    ),
    "a stretch up to an impact": (
        "hexagon_tumbles",
        "until the impact: ρ² θ'' = −g a sin(30° − θ)",
        "until the impact: (ρ² + a²) θ'' = −g a sin(30° − θ)",
        "is left out",
    ),
    "energy in an impact that takes some": (
        "crate_trips",
        "just after the trip: ½ m v² = ½ I_K ω²",
        "just after the trip: ½ m v h = I_K ω",
        "momentum",
    ),
    "energy of a fall in an impact that takes some": (
        "bar_caught",
        "just after the catch: (m + M) g h = ½ (⅓ m + M) L² ω²",
        "just after the catch: (½ m + M) √(2 g h) = (⅓ m + M) L ω",
        "momentum",
    ),
    "one factor of a product differentiated": (
        "stamp_mill",
        "while the pin lifts the stamp: y'' = r θ'' cos θ",
        "y'' = r θ'' cos θ − r θ'² sin θ",
        "centripetal",
    ),
    "one factor, of half an angle": (
        "drawbridge",
        "y'' = −L θ'' cos(θ/2)",
        "y'' = −L θ'' cos(θ/2) + ½ L θ'² sin(θ/2)",
        "centripetal",
    ),
    "an inertia that changes": (
        "slab_rocking_on_cylinder",
        "(I + m a² + m R² θ²) θ'' + m g (R θ cos θ − a sin θ) = 0",
        "(I + m a² + m R² θ²) θ'' + m R² θ θ'² + m g (R θ cos θ − a sin θ) = 0",
        "centripetal",
    ),
    "rotation of each of two bodies": (
        "wagons_with_buffer",
        "E_k = ½ (M_1 + m) x_1'² + ½ (M_2 + m) x_2'²",
        "E_k = ½ (M_1 + m + J/r²) x_1'² + ½ (M_2 + m + J/r²) x_2'²",
        "throughout",
    ),
    "weights and rotations of two bodies": (
        "pump_jack",
        "E_k = ½ M k² θ'²",
        "E_k = ½ M k² θ'² + ½ M c² θ'² + ½ m y'²",
        "kinetic energy",
    ),
    "a speed relative for absolute": (
        "puck_on_turntable",
        "H = m Ω (x² + y²)",
        "H = m Ω (x² + y²) + m (x y' − y x')",
        "momentum",
    ),
    "moment of a relative acceleration": (
        "puck_on_turntable",
        "Q = 2 m Ω (x x' + y y')",
        "Q = 2 m Ω (x x' + y y') + m (x y'' − y x'')",
        "left out",
    ),
    "a rate that is no part of a speed": (
        "blade_on_arm",
        "constant: 1/6 m L² (Ω + β̇)² − ½ m L R Ω² cos β",
        "1/6 m L² β̇² − ½ m L R Ω² cos β = const",
        "speed",
    ),
    "inertia of what hangs on, not another force": (
        "cycloid_reducer",
        "I θ'' = T − F e",
        "I θ'' = T − (F + m e θ'') e",
        "r × m a",
    ),
    "a sign in a constant of the start": (
        "puck_held_by_hanging_weight",
        "(m + M) r'' + m r_0² v_0²/r³ + M g = 0",
        "(m + M) r'' − m r_0² v_0²/r³ + M g = 0",
        "sense",
    ),
    "an angle of the statement's own": ("peaucellier_cell", "y = κ tan θ", "y = κ tan(θ/2)", "angle"),
    "what turns in a frequency": ("weight_pulley_spring", "ω_n² = k/m", "ω_n² = k/(m + I/r²)", "inertia"),
    "a screw in a frequency": ("screw_press", "ω_n² = k/m", "ω_n² = k p²/(4 π² J + m p²)", "inertia"),
    "a number below a root": ("rolling_on_spring", "ω_n = √(k/m)", "ω_n = √(2 k/(3 m))", "a number"),
    "the place where something vanishes": ("falling_chimney", "when c = L/2: Q = 0", "when c = L/3: Q = 0", "another value"),
    "what turns, not friction": (
        "wheelbarrow",
        "(M + m) ẍ = P − (M + m) g sin α",
        "(M + m + J/r²) ẍ = P − (M + m) g sin α",
        "inertia",
    ),
    "each of two wheels": (
        "road_roller",
        "(m + m_1 + m_2) x'' = M/r_1 − M_t g sin β",
        "(m + m_1 + m_2 + J_1/r_1² + J_2/r_2²) x'' = M/r_1 − M_t g sin β",
        "left out",
    ),
    "a bar as if held at its end": (
        "metronome",
        "I_O = M a² + m b² + ⅓ p L²",
        "I_O = M a² + m b² + 1/12 p L² + p d²",
        "another point",
    ),
    "the pull of a muscle": (
        "forearm_curl",
        "R_y − (M + m) g = (M e + m l)(θ'' cos θ − θ'² sin θ)",
        "R_y + F (b − a sin θ)/L − (M + m) g = (M e + m l)(θ'' cos θ − θ'² sin θ)",
        "a force",
    ),
    "where drag is c v²": ("radar_tracks_rocket", "F − c v² = m a", "F − c v² − m g = m a", "a weight"),
    "components of two forces": ("beads_on_wire", "N2 = T2 − T3", "N2 = T2 l/s2 − T3 l/s3", "project"),
    "the way along the other direction": (
        "bar_leans_on_crate",
        "while they touch: E = ½ m g l (sin θ0 − sin θ) − μ M g l (sin θ0 − sin θ)",
        "while they touch: E = ½ m g l (sin θ0 − sin θ) − μ M g l (cos θ − cos θ0)",
        "other direction",
    ),
    "all that turns as one": (
        "docking_craft",
        "after docking: E = ½ (m + M) v_G²",
        "after docking: E = ½ (m + M) v_G² + ½ (I + J + μ ρ²) ω²",
        "kinetic energy",
    ),
    "a lever that is the sum of two lengths": (
        "docking_craft",
        "just after docking: u_B = m d ω/(m + M)",
        "just after docking: u_B = m (a + c) ω/(m + M)",
        "another quantity",
    ),
    "three weights at once": ("balanced_linkage", "A_y + D_y = 0", "A_y + D_y = (m2 + m3 + m4) g", "a weight"),
    "the rates exchanged": (
        "mass_on_three_springs",
        "d_1' = [(x − a) y' + y x']/d_1",
        "d_1' = [(x − a) x' + y y']/d_1",
        "throughout",
    ),
    "small motions of lengths": (
        "mass_on_three_springs",
        "for small x, y: m x'' + (k1 + k3 cos γ) x + k3 y sin γ cos γ = 0",
        "for small x, y: m x'' + (k1 + k3 cos² γ) x + k3 y sin γ cos γ = 0",
        "factor",
    ),
    "what stands between two masses": (
        "beads_on_wire",
        "for small y_1, y_2: m y_2'' = −(S/l) y_2",
        "for small y_1, y_2: m y_2'' = −(S/l)(2 y_2 − y_1)",
        "left out",
    ),
    "twice one and a cosine": (
        "putty_on_hoop",
        "after the hit: K = M r² θ'² + ½ m r² θ'²",
        "after the hit: K = M r² θ'² + m r² (1 + cos θ) θ'²",
        "factor",
    ),
    "a sense where the start fixes the place": (
        "diving_board",
        "J θ'' = −K θ − ½ m g L cos θ + N L",
        "J θ'' = −K θ − ½ m g L cos θ − N L",
        "sense",
    ),
}


@every(SLIPS, "slip", share=8)
def test_the_first_correction_is_that_of_a_tutor(slip: str) -> None:
    name, said, right, words = SLIPS[slip]
    book = Book(name)
    first = judged_alone(book.checker, said).mends[0]
    assert book.says_the_same(first.equation, right), first
    assert words in first.why
