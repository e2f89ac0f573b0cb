"""Statements as people write them, by the letters that are known where they are made."""


def letters(text: str) -> list[str]:
    """Letters between blanks."""
    return text.split()


BLOCKS = letters("m1 m2 g theta x y' t F_A F_B F_C F_D i j k i' j' r_A/G1 r_B/G1 r_C/G1 r_D/G1 r_C/G2 r_D/G2")
ARM = letters("m1 m2 g theta1 theta2 t I1 I2 i j k M_s M_e r_G1/O r_G2/O r_G2/E a_G1 a_G2 a_G2/O a_G2/E H/O H/E ΣM/O ΣM/E")
WEDGES = letters("m1 m2 g alpha μ N R F a_rel a2 M C S n λ i j k")
GUN = letters("m1 m2 I1 R theta T v_R omega t W")
SLOPE = letters("M m g l theta alpha s t")
MOTOR = letters("M m epsilon theta x k T t")
WHEEL = letters("v_P v_P' v_rel a_P a_P' L ΣF m r i j k")
BAR = letters(
    "l1 l2 l3 theta beta phi t T I2 I3 m2 m3 λ1 λ2 λ3 n1 n2 n3 i j k a_G1 a_G2 a_G3 R_D R_Dx R_Dy w r_B r_C r_D r_D/A r_D/B r_D/C r_G2/B r_G3/C H_123/A H_23/B H_2/B H_3/B H_3/C"
)
LEGS = letters("H/A H/B ΣM/A ΣM/B")

STATEMENTS = [
    (BLOCKS, "0 = m1 ẍ + m2 (ẍ + ÿ' j')·i", "0 = m1*xddot + m2*(xddot + y'ddot*j') · i"),
    (BLOCKS, "(m1+m2) ẍ − m2 cosθ ÿ' = 0", "(m1 + m2)*xddot - m2*cos(theta)*y'ddot = 0"),
    (BLOCKS, "−m2 cosθ ẍ + m2 ÿ' = m2 g sinθ", "-m2*cos(theta)*xddot + m2*y'ddot = m2*g*sin(theta)"),
    (
        BLOCKS,
        "block 1, LMB: −F_C i' − F_D i' + F_B j + F_A j − m1 g j = m1 ẍ i",
        "-F_C*i' - F_D*i' + F_B*j + F_A*j - m1*g*j = m1*xddot*i",
    ),
    (
        BLOCKS,
        "block 1, AMB about G1: r_D/G1×(−F_D i') + r_C/G1×(−F_C i') + r_B/G1×F_B j + r_A/G1×F_A j = 0",
        "r_D/G1 × (-F_D*i') + r_C/G1 × (-F_C*i') + r_B/G1 × F_B*j + r_A/G1 × F_A*j = 0",
    ),
    (
        BLOCKS,
        "block 2, LMB: F_C i' + F_D i' − m2 g j' = m2 (ẍ i + ÿ' j')",
        "F_C*i' + F_D*i' - m2*g*j' = m2*(xddot*i + y'ddot*j')",
    ),
    (BLOCKS, "r_D/G2×F_D i' + r_C/G2×F_C i' = 0", "r_D/G2 × F_D*i' + r_C/G2 × F_C*i' = 0"),
    (
        ARM,
        "ΣM/O = r_G1/O×(m1 g i) + r_G2/O×(−m2 g j) + M_s k",
        "ΣM/O = r_G1/O × m1*g*i + r_G2/O × (-m2*g*j) + M_s*k",
    ),
    (ARM, "ΣM/E = r_G2/E×(m2 g i) + M_e k", "ΣM/E = r_G2/E × m2*g*i + M_e*k"),
    (
        ARM,
        "Ḣ/O = m1 r_G1/O×a_G1 + θ̈1 I1 k + m2 r_G2/O×a_G2 + θ̈2 I2 k",
        "Ḣ/O = m1*r_G1/O × a_G1 + theta1ddot*I1*k + m2*r_G2/O × a_G2 + theta2ddot*I2*k",
    ),
    (ARM, "Ḣ/E = m2 r_G2/E×a_G2/O + θ̈2 I2 k", "Ḣ/E = m2*r_G2/E × a_G2/O + theta2ddot*I2*k"),
    (
        ARM,
        "a_G2/E = −θ̇2² r_G2/E + θ̈2 k×r_G2/E",
        "a_G2/E = -theta2dot^2*r_G2/E + theta2ddot*k × r_G2/E",
    ),
    (WEDGES, "m1 a_rel = −m1 a2 cosα − μN + m1 g sinα", "m1*a_rel = -m1*a2*cos(alpha) - μ*N + m1*g*sin(alpha)"),
    (WEDGES, "m1 a2 sinα = N − m1 g cosα", "m1*a2*sin(alpha) = N - m1*g*cos(alpha)"),
    (WEDGES, "m2 a2 = −N sinα + μN cosα", "m2*a2 = -N*sin(alpha) + μ*N*cos(alpha)"),
    (WEDGES, "a2 = M C (μC−S) g / (1 − M S (μC−S))", "a2 = M*C*(μ*C - S)*g/(1 - M*S*(μ*C - S))"),
    (WEDGES, "N = m1 g C / (1 − M S (μC−S))", "N = m1*g*C/(1 - M*S*(μ*C - S))"),
    (
        WEDGES,
        "a_rel = gS − gC [M C (μC−S) − μ] / (1 − M S (μC−S))",
        "a_rel = g*S - g*C*(M*C*(μ*C - S) - μ)/(1 - M*S*(μ*C - S))",
    ),
    (WEDGES, "a_rel = gS + g M C² S / (1 + M S²)", "a_rel = g*S + g*M*C^2*S/(1 + M*S^2)"),
    (WEDGES, "a_rel = g sinα", "a_rel = g*sin(alpha)"),
    (WEDGES, "N n − m1 g j − μN λ = m1 (a2 i + a_rel λ)", "N*n - m1*g*j - μ*N*λ = m1*(a2*i + a_rel*λ)"),
    (WEDGES, "(R − m2 g) j − N n + μN λ = m2 a2 i", "(R - m2*g)*j - N*n + μ*N*λ = m2*a2*i"),
    (WEDGES, "F ≤ μN", "F <= μ*N"),
    (
        GUN,
        "θ̈ = T/(I1+m2R²) − 2 m2 R Ṙ θ̇/(I1+m2R²)",
        "thetaddot = T/(I1 + m2*R^2) - 2*m2*R*Rdot*thetadot/(I1 + m2*R^2)",
    ),
    (GUN, "R̈ = R θ̇²", "Rddot = R*thetadot^2"),
    (GUN, "(I1+m2R²)θ̈ + 2 m2 R Ṙ θ̇ = 0", "(I1 + m2*R^2)*thetaddot + 2*m2*R*Rdot*thetadot = 0"),
    (GUN, "v̇_R = v_R/(R ω²)", "v_Rdot = v_R/(R*omega^2)"),
    (
        GUN,
        "ω̇ = (T − 2 m2 R v_R ω)/(I1+I2) with I2 = m2R², v̇_R = R ω²",
        "omegadot = (T - 2*m2*R*v_R*omega)/(I1 + I2)\nI2 = m2*R^2\nv_Rdot = R*omega^2",
    ),
    (GUN, "W = Tθ", "W = T*theta"),
    (SLOPE, "θ̈ = −(g/ℓ) sin(θ−α) − (s̈/ℓ) cosθ", "thetaddot = -g/l*sin(theta - alpha) - sddot/l*cos(theta)"),
    (
        SLOPE,
        "(M+m) g sinα = (M+m) s̈ + mℓθ̈ cosθ − mℓθ̇² sinθ",
        "(M + m)*g*sin(alpha) = (M + m)*sddot + m*l*thetaddot*cos(theta) - m*l*thetadot^2*sin(theta)",
    ),
    (
        SLOPE,
        "s̈ = g sinα − mℓ/(M+m) (θ̈ cosθ + θ̇² sinθ)",
        "sddot = g*sin(alpha) - m*l/(M + m)*(thetaddot*cos(theta) + thetadot^2*sin(theta))",
    ),
    (
        SLOPE,
        "θ̈ = −(g/ℓ) sinθ (1+m/M) cosα/(1+(m/M) sin²θ) + (m/M) θ̇² sinθ cosθ/(1+(m/M) sin²θ)",
        "thetaddot = -g/l*sin(theta)*(1 + m/M)*cos(alpha)/(1 + m/M*sin(theta)^2)"
        " + m/M*thetadot^2*sin(theta)*cos(theta)/(1 + m/M*sin(theta)^2)",
    ),
    (
        SLOPE,
        "[ℓ, cosθ; mℓ cosθ, M+m] (θ̈, s̈) = (−(g/ℓ) sin(θ−α), (M+m) g sinα − mℓθ̇² sinθ)",
        "[l, cos(theta); m*l*cos(theta), M + m]*(thetaddot, sddot)"
        " = (-g/l*sin(theta - alpha), (M + m)*g*sin(alpha) - m*l*thetadot^2*sin(theta))",
    ),
    (SLOPE, "θ̈ = −(g/ℓ) sinθ", "thetaddot = -g/l*sin(theta)"),
    (MOTOR, "ε θ̈ − sinθ θ̇ = T/(mε)", "epsilon*thetaddot - sin(theta)*thetadot = T/(m*epsilon)"),
    (
        MOTOR,
        "−k x = (M+m) ẍ − mεθ̈ sinθ − mεθ̇² cosθ",
        "-k*x = (M + m)*xddot - m*epsilon*thetaddot*sin(theta) - m*epsilon*thetadot^2*cos(theta)",
    ),
    (
        MOTOR,
        "ε sinθ θ̈ − ((M+m)/m) ẍ = (k/m) x − εθ̇² cosθ",
        "epsilon*sin(theta)*thetaddot - (M + m)/m*xddot = k/m*x - epsilon*thetadot^2*cos(theta)",
    ),
    (
        MOTOR,
        "[ε, −sinθ; ε sinθ, −(m+M)/m] (θ̈, ẍ) = (T/(mε), (k/m) x − εθ̇² cosθ)",
        "[epsilon, -sin(theta); epsilon*sin(theta), -(m + M)/m]*(thetaddot, xddot)"
        " = (T/(m*epsilon), k/m*x - epsilon*thetadot^2*cos(theta))",
    ),
    (
        WHEEL,
        "v_P' = (−2.25 i + 6.50 j) m/s, v_rel = −(1.25 i + 2.16 j), v_P = (−3.50 i + 4.34 j)",
        "v_P' = (-2.25*i + 6.50*j) m/s\nv_rel = -(1.25*i + 2.16*j)\nv_P = -3.50*i + 4.34*j",
    ),
    (WHEEL, "L = (−1.75 i + 2.17 j) kg·m/s", "L = (-1.75*i + 2.17*j) kg·m/s"),
    (WHEEL, "a_P' = −(19.49 i + 6.75 j) m/s²", "a_P' = -(19.49*i + 6.75*j) m/s²"),
    (
        WHEEL,
        "a_P = −(17.83 i + 3.63 j) m/s², ΣF = −(8.92 i + 1.81 j) N",
        "a_P = -(17.83*i + 3.63*j) m/s²\nΣF = -(8.92*i + 1.81*j) N",
    ),
    (
        BAR,
        "[−ℓ2 sinβ, ℓ3 sinφ; −ℓ2 cosβ, ℓ3 cosφ] (β̇, φ̇) = θ̇ (ℓ1 sinθ, ℓ1 cosθ)",
        "[-l2*sin(beta), l3*sin(phi); -l2*cos(beta), l3*cos(phi)]*(betadot, phidot) = thetadot*(l1*sin(theta), l1*cos(theta))",
    ),
    (
        BAR,
        "[−ℓ2 sinβ, ℓ3 sinφ; −ℓ2 cosβ, ℓ3 cosφ] (β̈, φ̈) = −[−ℓ2 cosβ, ℓ3 cosφ; ℓ2 sinβ, −ℓ3 sinφ] (β̇², φ̇²) "
        "+ ℓ1 [sinθ, cosθ; cosθ, −sinθ] (θ̈, θ̇²)",
        "[-l2*sin(beta), l3*sin(phi); -l2*cos(beta), l3*cos(phi)]*(betaddot, phiddot)"
        " = -[-l2*cos(beta), l3*cos(phi); l2*sin(beta), -l3*sin(phi)]*(betadot^2, phidot^2)"
        " + l1*[sin(theta), cos(theta); cos(theta), -sin(theta)]*(thetaddot, thetadot^2)",
    ),
    (BAR, "a_G1 = −(ℓ1/2) θ̇² λ1", "a_G1 = -l1/2*thetadot^2*λ1"),
    (
        BAR,
        "a_G2 = −ℓ1 θ̇² λ1 − (ℓ2/2) β̇² λ2 + ℓ2 β̇ n2",
        "a_G2 = -l1*thetadot^2*λ1 - l2/2*betadot^2*λ2 + l2*betadot*n2",
    ),
    (BAR, "a_G3 = −(ℓ3/2) φ̇² λ3", "a_G3 = -l3/2*phidot^2*λ3"),
    (BAR, "T k + r_D/A×R_D = Ḣ_123/A", "T*k + r_D/A × R_D = Ḣ_123/A"),
    (
        BAR,
        "[1, 0, 0; 0, k·(ℓ2λ2−ℓ3λ3)×i, k·(ℓ2λ2−ℓ3λ3)×j; 0, k·(−ℓ3λ3×i), k·(−ℓ3λ3×j)] (T, R_Dx, R_Dy) = (Ḣ_123/A, Ḣ_23/B, Ḣ_3/C)",
        "[1, 0, 0; 0, k · (l2*λ2 - l3*λ3) × i, k · (l2*λ2 - l3*λ3) × j; 0, k · (-l3*λ3 × i), k · (-l3*λ3 × j)]*(T, R_Dx, R_Dy)"
        " = (Ḣ_123/A, Ḣ_23/B, Ḣ_3/C)",
    ),
    (
        BAR,
        "β̇ = −(ℓ1/ℓ2) [(n1×λ3)/(n2×λ3)] θ̇ and φ̇ = (ℓ1/ℓ3) [(n1×λ2)/(n3×λ2)] θ̇",
        "betadot = -l1/l2*((n1 × λ3)/(n2 × λ3))*thetadot\nphidot = l1/l3*((n1 × λ2)/(n3 × λ2))*thetadot",
    ),
    (
        BAR,
        "B w = C c + D d with B = [−ℓ2 sinβ, ℓ3 sinφ; −ℓ2 cosβ, ℓ3 cosφ], C = ℓ1 [sinθ, cosθ; cosθ, −sinθ], c = (θ̈, θ̇²), "
        "D = [−cosβ, cosφ; sinβ, −sinφ], d = (ℓ2 β̇², ℓ3 φ̇²)",
        "B*w = C*c + D*d\nB = [-l2*sin(beta), l3*sin(phi); -l2*cos(beta), l3*cos(phi)]\n"
        "C = l1*[sin(theta), cos(theta); cos(theta), -sin(theta)]\nc = (thetaddot, thetadot^2)\n"
        "D = [-cos(beta), cos(phi); sin(beta), -sin(phi)]\nd = (l2*betadot^2, l3*phidot^2)",
    ),
    (
        BAR,
        "r_D/B×R_D = Ḣ_2/B + Ḣ_3/B, with Ḣ_2/B = I2 β̈ k + r_G2/B×m2 a_G2",
        "r_D/B × R_D = Ḣ_2/B + Ḣ_3/B\nḢ_2/B = I2*betaddot*k + r_G2/B × m2*a_G2",
    ),
    (BAR, "r_D/C×R_D = I3 φ̈ k + r_G3/C×m3 a_G3", "r_D/C × R_D = I3*phiddot*k + r_G3/C × m3*a_G3"),
    (
        BAR,
        "a_G1 = (ℓ1/2)(θ̈ n1 − θ̇² λ1), a_G2 = 2 a_G1 + (ℓ2/2)(β̈ n2 − β̇² λ2), a_G3 = (ℓ3/2)(φ̈ n3 − φ̇² λ3)",
        "a_G1 = l1/2*(thetaddot*n1 - thetadot^2*λ1)\na_G2 = 2*a_G1 + l2/2*(betaddot*n2 - betadot^2*λ2)\n"
        "a_G3 = l3/2*(phiddot*n3 - phidot^2*λ3)",
    ),
    (
        BAR,
        "[1, k·r_D×i, k·r_D×j; 0, k·(r_D−r_B)×i, k·(r_D−r_B)×j; 0, k·(r_D−r_C)×i, k·(r_D−r_C)×j] (T, R_Dx, R_Dy)"
        " = (Ḣ_123/A, Ḣ_23/B, Ḣ_3/C)",
        "[1, k · r_D × i, k · r_D × j; 0, k · (r_D - r_B) × i, k · (r_D - r_B) × j; 0, k · (r_D - r_C) × i, k · (r_D - r_C) × j]"
        "*(T, R_Dx, R_Dy) = (Ḣ_123/A, Ḣ_23/B, Ḣ_3/C)",
    ),
    (LEGS, "ΣM/A = Ḣ/A", "ΣM/A = Ḣ/A"),
]
