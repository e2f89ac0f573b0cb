/*
 * The yardstick: accelerations and all pin reactions of a chain of uniform bars hanging from the ground, by the
 * plain planar articulated-body sweep, as one would write it by hand in C.
 *
 * Usage: sweep LINKS REPEATS   prints: LINKS, seconds per solve, largest Newton-Euler residual (relative).
 *
 * Notation: r from the link's own pin to its child's pin, g to its mass centre, r' the vector r turned left;
 * the child hands up its projected mass M (symmetric 2x2) and bias force f, both at its pin.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

typedef struct { double x, y; } Vec;
typedef struct { double xx, xy, yy; } Sym;

typedef struct { double length, mass, inertia; } Bar; /* inertia about the mass centre */

typedef struct {
    Vec r, g;     /* own pin to child's pin, to the mass centre */
    double w2;    /* square of the angular velocity */
    Vec h;        /* coupling of rotation and translation at the pin */
    double T;     /* bias couple about the pin, children included */
    double iJ;    /* one over the inertia about the pin, children included */
    Sym M;        /* what the link hands to its parent */
    Vec f;
} Link;

typedef struct { Vec reaction, pin; double alpha; } Answer; /* force on the link at its own pin, its acceleration */

static const Vec gravity = {0.0, -9.81};

static Vec add(Vec a, Vec b) { return (Vec){a.x + b.x, a.y + b.y}; }
static Vec sub(Vec a, Vec b) { return (Vec){a.x - b.x, a.y - b.y}; }
static Vec scale(double s, Vec a) { return (Vec){s * a.x, s * a.y}; }
static Vec left(Vec a) { return (Vec){-a.y, a.x}; }
static Vec times(Sym m, Vec a) { return (Vec){m.xx * a.x + m.xy * a.y, m.xy * a.x + m.yy * a.y}; }
static double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y; }
static double cross(Vec a, Vec b) { return a.x * b.y - a.y * b.x; }
static double size(Vec a) { return sqrt(dot(a, a)); }

/* Root to leaf: directions and angular velocities from the joint angles and rates. */
static void forward(int n, const Bar *bar, const double *q, const double *u, Link *link) {
    double angle = 0.0, omega = 0.0;
    for (int i = 0; i < n; i++) {
        angle += q[i];
        omega += u[i];
        double s = sin(angle), c = cos(angle); /* one sincos at -O2 */
        link[i].r = (Vec){bar[i].length * c, bar[i].length * s};
        link[i].g = scale(0.5, link[i].r);
        link[i].w2 = omega * omega;
    }
}

/* Leaf to root: mass and bias of everything beyond each pin, its rotation eliminated. */
static void reduce(int n, const Bar *bar, Link *link) {
    Sym M = {0.0, 0.0, 0.0};
    Vec f = {0.0, 0.0};
    double couple = 0.0; /* of the motor in the child's pin: these pins are free */
    for (int i = n - 1; i >= 0; i--) {
        Link *k = &link[i];
        double m = bar[i].mass;
        Vec across = left(k->r);
        Vec u = times(M, across);
        Vec own = sub(scale(-m * k->w2, k->g), scale(m, gravity));
        Vec beyond = sub(f, scale(k->w2, times(M, k->r)));
        k->h = add(scale(m, left(k->g)), u);
        k->iJ = 1.0 / (bar[i].inertia + m * dot(k->g, k->g) + dot(across, u));
        k->T = cross(k->g, own) + cross(k->r, beyond) + couple;
        Vec F = add(own, beyond);
        M.xx += m - k->h.x * k->h.x * k->iJ;
        M.xy += -k->h.x * k->h.y * k->iJ;
        M.yy += m - k->h.y * k->h.y * k->iJ;
        f = sub(F, scale(k->T * k->iJ, k->h));
        k->M = M;
        k->f = f;
    }
}

/* Root to leaf: the force in each pin, the angular acceleration, the acceleration of the next pin. */
static void expand(int n, const Link *link, Answer *answer) {
    Vec a = {0.0, 0.0};
    for (int i = 0; i < n; i++) {
        const Link *k = &link[i];
        double alpha = -(k->T + dot(k->h, a)) * k->iJ;
        answer[i] = (Answer){add(times(k->M, a), k->f), a, alpha};
        a = add(a, sub(scale(alpha, left(k->r)), scale(k->w2, k->r)));
    }
}

static void solve(int n, const Bar *bar, const double *q, const double *u, Link *link, Answer *answer) {
    forward(n, bar, q, u, link);
    reduce(n, bar, link);
    expand(n, link, answer);
}

/* What Newton and Euler leave of every link, relative to the largest force: the yardstick is right, or says so. */
static double residual(int n, const Bar *bar, const Link *link, const Answer *answer) {
    double worst = 0.0, largest = 0.0;
    for (int i = 0; i < n; i++) {
        const Link *k = &link[i];
        const Answer *x = &answer[i];
        Vec next = i + 1 < n ? answer[i + 1].reaction : (Vec){0.0, 0.0};
        Vec centre = add(x->pin, sub(scale(x->alpha, left(k->g)), scale(k->w2, k->g)));
        Vec force = sub(add(x->reaction, scale(bar[i].mass, gravity)), next);
        Vec lost = sub(force, scale(bar[i].mass, centre));
        double moment = -cross(k->g, x->reaction) - cross(sub(k->r, k->g), next);
        worst = fmax(worst, fmax(size(lost), fabs(moment - bar[i].inertia * x->alpha) / bar[i].length));
        largest = fmax(largest, size(x->reaction));
    }
    return worst / largest;
}

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

static void *array(int n, size_t bytes) {
    void *found = calloc(n, bytes);
    if (!found) exit(1);
    return found;
}

int main(int count, char **words) {
    int n = count == 3 ? atoi(words[1]) : 0, repeats = count == 3 ? atoi(words[2]) : 0;
    if (n < 1 || repeats < 1) return fprintf(stderr, "usage: sweep LINKS REPEATS\n"), 2;
    Bar *bar = array(n, sizeof *bar);
    double *q = array(n, sizeof *q), *u = array(n, sizeof *u);
    Link *link = array(n, sizeof *link);
    Answer *answer = array(n, sizeof *answer);
    for (int i = 0; i < n; i++) {
        bar[i] = (Bar){1.0, 1.0, 1.0 / 12.0};
        q[i] = 0.3 * sin(1.0 + i);
        u[i] = 0.5 * cos(2.0 * i);
    }
    double seen = 0.0, start = now();
    for (int k = 0; k < repeats; k++) {
        q[0] += 1e-9; /* every solve is a new one, and its answer is used */
        solve(n, bar, q, u, link, answer);
        seen += answer[n - 1].alpha;
    }
    double each = (now() - start) / repeats;
    double left_over = residual(n, bar, link, answer);
    printf("%d %.9e %.2e\n", n, each, left_over);
    return isfinite(seen) && left_over <= 1e-12 ? 0 : 1;
}
