// A double pendulum and a four-bar as one would write them by hand, with the same method: a yardstick for motions; see motions.py.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

// Of stages 1 to 11 and 13 to 15, those of the dense output.
constexpr double C[] = {
    0.05260015195876773, 0.0789002279381516, 0.1183503419072274, 0.2816496580927726, 0.3333333333333333, 0.25,
    0.3076923076923077, 0.6512820512820513, 0.6, 0.8571428571428571, 1.0, 0.1, 0.2, 0.7777777777777778,
};
// The weights of the stages, row after row.
constexpr double A[] = {
    0.05260015195876773, 0.0197250569845379, 0.0591751709536137, 0.02958758547680685, 0.0, 0.08876275643042054,
    0.2413651341592667, 0.0, -0.8845494793282861, 0.924834003261792, 0.037037037037037035, 0.0, 0.0,
    0.17082860872947386, 0.12546768756682242, 0.037109375, 0.0, 0.0, 0.17025221101954405, 0.06021653898045596,
    -0.017578125, 0.03709200011850479, 0.0, 0.0, 0.17038392571223998, 0.10726203044637328, -0.015319437748624402,
    0.008273789163814023, 0.6241109587160757, 0.0, 0.0, -3.3608926294469414, -0.868219346841726, 27.59209969944671,
    20.154067550477894, -43.48988418106996, 0.47766253643826434, 0.0, 0.0, -2.4881146199716677, -0.590290826836843,
    21.230051448181193, 15.279233632882423, -33.28821096898486, -0.020331201708508627, -0.9371424300859873, 0.0, 0.0,
    5.186372428844064, 1.0914373489967295, -8.149787010746927, -18.52006565999696, 22.739487099350505,
    2.4936055526796523, -3.0467644718982196, 2.273310147516538, 0.0, 0.0, -10.53449546673725, -2.0008720582248625,
    -17.9589318631188, 27.94888452941996, -2.8589982771350235, -8.87285693353063, 12.360567175794303,
    0.6433927460157636, 0.056167502283047954, 0.0, 0.0, 0.0, 0.0, 0.0, 0.25350021021662483, -0.2462390374708025,
    -0.12419142326381637, 0.15329179827876568, 0.00820105229563469, 0.007567897660545699, -0.008298,
    0.03183464816350214, 0.0, 0.0, 0.0, 0.0, 0.028300909672366776, 0.053541988307438566, -0.05492374857139099, 0.0,
    0.0, -0.00010834732869724932, 0.0003825710908356584, -0.00034046500868740456, 0.1413124436746325,
    -0.42889630158379194, 0.0, 0.0, 0.0, 0.0, -4.697621415361164, 7.683421196062599, 4.06898981839711,
    0.3567271874552811, 0.0, 0.0, 0.0, -0.0013990241651590145, 2.9475147891527724, -9.15095847217987,
};
constexpr double B[] = {
    0.054293734116568765, 0.0, 0.0, 0.0, 0.0, 4.450312892752409, 1.8915178993145003, -5.801203960010585,
    0.3111643669578199, -0.1521609496625161, 0.20136540080403034, 0.04471061572777259,
};
constexpr double E[2][12] = {{
    0.01312004499419488, 0.0, 0.0, 0.0, 0.0, -1.2251564463762044, -0.4957589496572502, 1.6643771824549864,
    -0.35032884874997366, 0.3341791187130175, 0.08192320648511571, -0.022355307863886294,
}, {
    -0.18980075407240762, 0.0, 0.0, 0.0, 0.0, 4.450312892752409, 1.8915178993145003, -5.801203960010585,
    -0.42268232132379197, -0.1521609496625161, 0.20136540080403034, 0.022651792198360825,
}};
constexpr double D[4][16] = {{
    -8.428938276109013, 0.0, 0.0, 0.0, 0.0, 0.5667149535193777, -3.0689499459498917, 2.38466765651207,
    2.117034582445028, -0.871391583777973, 2.2404374302607883, 0.6315787787694688, -0.08899033645133331,
    18.148505520854727, -9.194632392478356, -4.436036387594894,
}, {
    10.427508642579134, 0.0, 0.0, 0.0, 0.0, 242.28349177525817, 165.20045171727028, -374.5467547226902,
    -22.113666853125306, 7.733432668472264, -30.674084731089398, -9.332130526430229, 15.697238121770845,
    -31.139403219565178, -9.35292435884448, 35.81684148639408,
}, {
    19.985053242002433, 0.0, 0.0, 0.0, 0.0, -387.0373087493518, -189.17813819516758, 527.8081592054236,
    -11.57390253995963, 6.8812326946963, -1.0006050966910838, 0.7777137798053443, -2.778205752353508,
    -60.19669523126412, 84.32040550667716, 11.99229113618279,
}, {
    -25.69393346270375, 0.0, 0.0, 0.0, 0.0, -154.18974869023643, -231.5293791760455, 357.6391179106141,
    93.40532418362432, -37.45832313645163, 104.0996495089623, 29.8402934266605, -43.53345659001114,
    96.32455395918828, -39.17726167561544, -149.72683625798564,
}};

// The accepted steps of a motion with their dense output, as many numbers as a program would keep that is asked at any time.
template <int N> struct Motion {
    std::array<double, N> y;
    std::vector<std::array<double, 8 * N + 1>> steps;
    long evaluations = 0;
};

// DOP853 (Hairer, Norsett & Wanner, Solving ODEs I, II.5 and II.10) from 0 to `end`, with the error norm of Hairer's code.
template <int N, class Rate> Motion<N> integrate(Rate rate, std::array<double, N> y, double end, double rtol) {
    using Vec = std::array<double, N>;
    Motion<N> run{y, {}, 0};
    std::array<Vec, 16> k;
    Vec at, next;
    double t = 0, h = 1e-4 * end, last = 1e-4;
    bool rejected = false;
    rate(t, y, k[0]);
    const auto stage = [&](int s, const double *a, double c, int count) {
        for (int i = 0; i < N; i++) {
            double sum = 0;
            for (int j = 0; j < count; j++) sum += a[j] * k[j][i];
            at[i] = y[i] + h * sum;
        }
        rate(t + c * h, at, k[s]);
    };
    run.evaluations = 1;
    while (t < end) {
        h = std::min(h, end - t);
        const double *a = A;
        for (int s = 1; s < 12; s++) { stage(s, a, C[s - 1], s); a += s; }
        double e5 = 0, e3 = 0;
        for (int i = 0; i < N; i++) {
            double sum = 0, x5 = 0, x3 = 0;
            for (int j = 0; j < 12; j++) { sum += B[j] * k[j][i]; x5 += E[0][j] * k[j][i]; x3 += E[1][j] * k[j][i]; }
            next[i] = y[i] + h * sum;
            const double size = rtol * (1e-3 + std::max(std::abs(y[i]), std::abs(next[i])));
            e5 += (x5 / size) * (x5 / size);
            e3 += (x3 / size) * (x3 / size);
        }
        const double error = std::abs(h) * e5 / std::sqrt(std::max(e5 + 0.01 * e3, 1e-300) * N);
        run.evaluations += 11;
        if (error > 1) {
            h *= std::max(0.33, 0.9 * std::pow(error, -1.0 / 8));
            rejected = true;
            continue;
        }
        rate(t + h, next, k[12]);
        for (int s = 13; s < 16; s++) { stage(s, a, C[s - 2], s); a += s; }
        run.evaluations += 4;
        auto &step = run.steps.emplace_back();
        step[8 * N] = t;
        for (int i = 0; i < N; i++) {
            const double rise = next[i] - y[i];
            step[i] = y[i];
            step[N + i] = rise;
            step[2 * N + i] = h * k[0][i] - rise;
            step[3 * N + i] = 2 * rise - h * (k[0][i] + k[12][i]);
            for (int d = 0; d < 4; d++) {
                double sum = 0;
                for (int j = 0; j < 16; j++) sum += D[d][j] * k[j][i];
                step[(4 + d) * N + i] = h * sum;
            }
        }
        t = h == end - t ? end : t + h;
        y = next;
        k[0] = k[12];
        const double factor = 0.9 * std::pow(std::max(error, 1e-10), -0.85 / 8) * std::pow(last, 0.2 / 8);
        h *= std::clamp(factor, 0.33, rejected ? 1.0 : 6.0);
        last = std::max(error, 1e-4);
        rejected = false;
    }
    run.y = y;
    return run;
}

constexpr double g = 9.81;

// Two uniform bars, 1 m and 1 kg each, by their angles from the x axis: Lagrange's equations by hand.
void pendulum(double, const std::array<double, 4> &y, std::array<double, 4> &dy) {
    const double s = std::sin(y[0] - y[1]), c = std::cos(y[0] - y[1]);
    const double m11 = 4.0 / 3, m12 = 0.5 * c, m22 = 1.0 / 3;
    const double f1 = -0.5 * s * y[3] * y[3] - 1.5 * g * std::cos(y[0]), f2 = 0.5 * s * y[2] * y[2] - 0.5 * g * std::cos(y[1]);
    const double det = m11 * m22 - m12 * m12;
    dy = {y[2], y[3], (f1 * m22 - f2 * m12) / det, (m11 * f2 - m12 * f1) / det};
}

// A four-bar, bars of 1, 2.5 and 2 m with 1, 2 and 1.5 kg, pivots 2 m apart, by three angles from the x axis: inertia of each bar
// along its two angles, two rows that close the loop, and elimination with pivots.
constexpr double L[3] = {1, 2.5, 2}, M[3] = {1, 2, 1.5};
void four_bar(double, const std::array<double, 6> &y, std::array<double, 6> &dy) {
    double s[3], c[3];
    for (int i = 0; i < 3; i++) { s[i] = std::sin(y[i]); c[i] = std::cos(y[i]); }
    const double *w = &y[3], h = 0.5 * M[1] * L[0] * L[1];
    const double sd = s[0] * c[1] - c[0] * s[1], cd = c[0] * c[1] + s[0] * s[1];
    double a[5][6] = {
        {M[0] * L[0] * L[0] / 3 + M[1] * L[0] * L[0], h * cd, 0, -L[0] * s[0], L[0] * c[0],
         -h * sd * w[1] * w[1] - (0.5 * M[0] + M[1]) * g * L[0] * c[0]},
        {h * cd, M[1] * L[1] * L[1] / 3, 0, -L[1] * s[1], L[1] * c[1], h * sd * w[0] * w[0] - 0.5 * M[1] * g * L[1] * c[1]},
        {0, 0, M[2] * L[2] * L[2] / 3, L[2] * s[2], -L[2] * c[2], -0.5 * M[2] * g * L[2] * c[2]},
        {-L[0] * s[0], -L[1] * s[1], L[2] * s[2], 0, 0, 0},
        {L[0] * c[0], L[1] * c[1], -L[2] * c[2], 0, 0, 0}};
    for (int i = 0; i < 3; i++) {
        const double side = i < 2 ? L[i] * w[i] * w[i] : -L[i] * w[i] * w[i];
        a[3][5] += side * c[i];
        a[4][5] += side * s[i];
    }
    for (int k = 0; k < 5; k++) {
        int best = k;
        for (int i = k + 1; i < 5; i++) if (std::abs(a[i][k]) > std::abs(a[best][k])) best = i;
        if (best != k) std::swap(a[k], a[best]);
        for (int i = k + 1; i < 5; i++) {
            const double part = a[i][k] / a[k][k];
            for (int j = k + 1; j < 6; j++) a[i][j] -= part * a[k][j];
        }
    }
    double x[5];
    for (int k = 4; k >= 0; k--) {
        x[k] = a[k][5];
        for (int j = k + 1; j < 5; j++) x[k] -= a[k][j] * x[j];
        x[k] /= a[k][k];
    }
    for (int i = 0; i < 3; i++) { dy[i] = w[i]; dy[3 + i] = x[i]; }
}

template <int N, class Rate> void report(Rate rate, std::array<double, N> y, double rtol, int repeats) {
    const std::clock_t begin = std::clock();
    Motion<N> run;
    for (int i = 0; i < repeats; i++) run = integrate<N>(rate, y, 10.0, rtol);
    const double seconds = double(std::clock() - begin) / CLOCKS_PER_SEC / repeats;
    std::printf("%.9e %ld", seconds, run.evaluations);
    for (double x : run.y) std::printf(" %.17g", x);
    std::printf("\n");
}

// motions pendulum|four_bar RTOL REPEATS Y...: seconds of a motion of 10 s, evaluations, the state at the end.
int main(int, char **args) {
    const double rtol = std::atof(args[2]);
    const int repeats = std::atoi(args[3]);
    const auto start = [&](auto &y) { for (size_t i = 0; i < y.size(); i++) y[i] = std::atof(args[4 + i]); return y; };
    std::array<double, 4> two;
    std::array<double, 6> three;
    if (args[1][0] == 'p') report<4>(pendulum, start(two), rtol, repeats);
    else report<6>(four_bar, start(three), rtol, repeats);
}
