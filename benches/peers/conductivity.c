/* A block of N^3 cells whose conductivity k0 (1 + b (T - T_ref)) depends on temperature: heat into
   z0, convection and radiation at z1. With theta = integral of k the flow between cells is
   (theta_i - theta_j) d. CVODE with SPGMR and incomplete Cholesky factors; steady: Newton with
   conjugate gradients in theta.
   conductivity NET.BIN ROWS.BIN TOLERANCE run|steady */
#include "laws.h"

#define ABSOLUTE_ZERO 273.15
#define KRYLOV_VECTORS 30

typedef struct {
    const Net *net;
    int N, n;
    double side, k0, b, reference, capacity, power, h, emission, air; /* of one cell */
    double *theta, *slope; /* integral of k in W/m; k in W/(m K) */
    double *surface, *flow, *out; /* of each cell of z1: degC, W, W/K in theta's place */
    double *pivot, *work[4]; /* the preconditioner; vectors of conjugate gradients */
} Block;

static double conductivity(const Block *b, double T)
{
    return b->k0 * (1 + b->b * (T - b->reference));
}
static double integral(const Block *b, double T)
{
    double x = T - b->reference;
    return b->k0 * (x + 0.5 * b->b * x * x);
}
static double inverse(const Block *b, double theta)
{
    double x = theta / b->k0; /* stable where b is small */
    return b->reference + 2 * x / (1 + sqrt(1 + 2 * b->b * x));
}

/* The surface of a cell of z1, by Newton's method from its last temperature: 2 side (theta -
   theta_s) leaves by convection and radiation. `out` is d flow / d theta of the cell. */
static void solve_surface(Block *b, int face, double theta)
{
    double T = b->surface[face], area = b->side * b->side, wall = b->air + ABSOLUTE_ZERO;
    double away = 0, in = 0, out = 0;
    for (int k = 0; k < 50; k++) {
        double hot = T + ABSOLUTE_ZERO;
        away = area * (b->h * (T - b->air) +
                       b->emission * (hot * hot * hot * hot - wall * wall * wall * wall));
        out = area * (b->h + 4 * b->emission * hot * hot * hot);
        in = 2 * b->side * conductivity(b, T);
        double change = (2 * b->side * (theta - integral(b, T)) - away) / (in + out);
        T += change;
        if (fabs(change) < 1e-12 * hot)
            break;
    }
    b->surface[face] = T;
    b->flow[face] = away;
    b->out[face] = 2 * b->side * out / (in + out);
}

/* q = heat into every cell less what flows out, by theta */
static void heat(Block *b, const double *theta, double *q)
{
    int N = b->N, layer = N * N, n = b->n;
    for (int c = 0; c < n; c++)
        q[c] = c < layer ? b->power / layer : 0;
    for (int k = 0; k < N; k++)
        for (int j = 0; j < N; j++)
            for (int i = 0, c = k * layer + j * N; i < N; i++, c++) {
                double here = theta[c], sum = 0, flow;
                if (i + 1 < N)
                    flow = b->side * (here - theta[c + 1]), sum += flow, q[c + 1] += flow;
                if (j + 1 < N)
                    flow = b->side * (here - theta[c + N]), sum += flow, q[c + N] += flow;
                if (k + 1 < N)
                    flow = b->side * (here - theta[c + layer]), sum += flow, q[c + layer] += flow;
                q[c] -= sum;
            }
    for (int face = 0; face < layer; face++) {
        solve_surface(b, face, theta[n - layer + face]);
        q[n - layer + face] -= b->flow[face];
    }
}

static int rate(double t, N_Vector T_, N_Vector rate_, void *data)
{
    Block *b = data;
    const double *T = N_VGetArrayPointer(T_);
    double *rate = N_VGetArrayPointer(rate_);
    for (int c = 0; c < b->n; c++)
        b->theta[c] = integral(b, T[c]);
    heat(b, b->theta, rate);
    for (int c = 0; c < b->n; c++)
        rate[c] /= b->capacity;
    (void)t;
    return 0;
}

/* y = K x: the conductances between cells and of the surfaces, in theta */
static void multiply(const Block *b, const double *x, double *y)
{
    int N = b->N, layer = N * N, n = b->n;
    for (int k = 0; k < N; k++)
        for (int j = 0; j < N; j++)
            for (int i = 0, c = k * layer + j * N; i < N; i++, c++) {
                double sum = 0, here = x[c];
                if (i > 0)
                    sum += here - x[c - 1];
                if (i + 1 < N)
                    sum += here - x[c + 1];
                if (j > 0)
                    sum += here - x[c - N];
                if (j + 1 < N)
                    sum += here - x[c + N];
                if (k > 0)
                    sum += here - x[c - layer];
                if (k + 1 < N)
                    sum += here - x[c + layer];
                y[c] = b->side * sum;
            }
    for (int face = 0; face < layer; face++)
        y[n - layer + face] += b->out[face] * x[n - layer + face];
}

static int times_jacobian(N_Vector v_, N_Vector Jv_, double t, N_Vector T, N_Vector rate_,
                          void *data, N_Vector scratch)
{
    Block *b = data;
    const double *v = N_VGetArrayPointer(v_);
    double *Jv = N_VGetArrayPointer(Jv_), *scaled = N_VGetArrayPointer(scratch);
    for (int c = 0; c < b->n; c++)
        scaled[c] = b->slope[c] * v[c];
    multiply(b, scaled, Jv);
    for (int c = 0; c < b->n; c++)
        Jv[c] /= -b->capacity;
    (void)t, (void)T, (void)rate_;
    return 0;
}

static int slopes(double t, N_Vector T_, N_Vector rate_, void *data)
{
    Block *b = data;
    const double *T = N_VGetArrayPointer(T_);
    for (int c = 0; c < b->n; c++)
        b->slope[c] = conductivity(b, T[c]);
    (void)t, (void)rate_;
    return 0;
}

/* Pivots of the incomplete factors of diag(shift / k) + scale K; shift 0 leaves K. */
static void factorise(Block *b, double shift, double scale)
{
    int N = b->N, layer = N * N;
    double g = scale * b->side;
    for (int k = 0; k < N; k++)
        for (int j = 0; j < N; j++)
            for (int i = 0, c = k * layer + j * N; i < N; i++, c++) {
                int sides = (i > 0) + (i + 1 < N) + (j > 0) + (j + 1 < N) + (k > 0) + (k + 1 < N);
                double pivot = g * sides + (shift > 0 ? shift / b->slope[c] : 0);
                if (k + 1 == N)
                    pivot += scale * b->out[c - (b->n - layer)];
                if (i > 0)
                    pivot -= g * g * b->pivot[c - 1];
                if (j > 0)
                    pivot -= g * g * b->pivot[c - N];
                if (k > 0)
                    pivot -= g * g * b->pivot[c - layer];
                b->pivot[c] = 1 / pivot;
            }
}

static void apply(const Block *b, double scale, const double *r, double *z)
{
    int N = b->N, layer = N * N;
    double g = scale * b->side;
    for (int k = 0; k < N; k++)
        for (int j = 0; j < N; j++)
            for (int i = 0, c = k * layer + j * N; i < N; i++, c++)
                z[c] = b->pivot[c] * (r[c] + g * ((i > 0 ? z[c - 1] : 0) + (j > 0 ? z[c - N] : 0) +
                                                  (k > 0 ? z[c - layer] : 0)));
    for (int k = N - 1; k >= 0; k--)
        for (int j = N - 1; j >= 0; j--)
            for (int i = N - 1, c = k * layer + j * N + i; i >= 0; i--, c--)
                z[c] += b->pivot[c] * g *
                        ((i + 1 < N ? z[c + 1] : 0) + (j + 1 < N ? z[c + N] : 0) +
                         (k + 1 < N ? z[c + layer] : 0));
}

static int prepare(double t, N_Vector T, N_Vector rate_, int jok, int *renewed, double gamma,
                   void *data)
{
    Block *b = data;
    slopes(t, T, rate_, b);
    factorise(b, b->capacity, gamma);
    *renewed = !jok;
    return 0;
}

/* (I + gamma K k / C) z = r: (C / k + gamma K) (k z) = C r */
static int precondition(double t, N_Vector T, N_Vector rate_, N_Vector r_, N_Vector z_,
                        double gamma, double delta, int side, void *data)
{
    Block *b = data;
    double *r = N_VGetArrayPointer(r_), *z = N_VGetArrayPointer(z_);
    for (int c = 0; c < b->n; c++)
        z[c] = r[c] * b->capacity;
    apply(b, gamma, z, z);
    for (int c = 0; c < b->n; c++)
        z[c] /= b->slope[c];
    (void)t, (void)T, (void)rate_, (void)delta, (void)side;
    return 0;
}

static double dot(const double *x, const double *y, int n)
{
    double sum = 0;
    for (int c = 0; c < n; c++)
        sum += x[c] * y[c];
    return sum;
}

/* K x = q by conjugate gradients, to a residual of `share` of q; q is overwritten by it. */
static void solve(Block *b, double *q, double *x, double share)
{
    int n = b->n;
    double *z = b->work[1], *p = b->work[2], *Kp = b->work[3];
    double stop = share * share * dot(q, q, n), before = 0;
    memset(x, 0, sizeof(double) * n);
    factorise(b, 0, 1);
    for (int step = 0; step < 10 * n && dot(q, q, n) > stop; step++) {
        apply(b, 1, q, z);
        double now = dot(q, z, n);
        for (int c = 0; c < n; c++)
            p[c] = z[c] + (step ? now / before * p[c] : 0);
        multiply(b, p, Kp);
        double along = now / dot(p, Kp, n);
        for (int c = 0; c < n; c++)
            x[c] += along * p[c], q[c] -= along * Kp[c];
        before = now;
    }
}

static void settle(Block *b, Run *run)
{
    double *T = N_VGetArrayPointer(run->state), *q = b->work[0], *change = doubles(b->n),
           largest = 1;
    for (int c = 0; c < b->n; c++)
        b->theta[c] = integral(b, T[c]);
    for (int step = 0; step < 50 && largest > b->net->tolerance; step++) {
        heat(b, b->theta, q);
        solve(b, q, change, 1e-6);
        largest = 0;
        for (int c = 0; c < b->n; c++) {
            b->theta[c] += change[c];
            largest = fmax(largest, fabs(change[c]) / b->k0);
        }
    }
    for (int c = 0; c < b->n; c++)
        T[c] = inverse(b, b->theta[c]);
    keep_row(run);
}

int main(int argc, char **argv)
{
    if (argc != 5)
        return 2;
    Net net = load_net(argv[1], argv[3]);
    const double *x = net.array[0] + 3;
    int n = net.n, N = (int)lround(cbrt(n)), layer = N * N;
    Block b = {&net, N, n, x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7], x[8]};
    double **vectors[] = {&b.theta,   &b.slope,   &b.pivot,  &b.work[0],
                          &b.work[1], &b.work[2], &b.work[3]};
    for (int k = 0; k < 7; k++)
        *vectors[k] = doubles(n);
    b.surface = doubles(layer), b.flow = doubles(layer), b.out = doubles(layer);
    for (int face = 0; face < layer; face++)
        b.surface[face] = b.air;
    Run run = begin(&net, rate, &b);
    if (!strcmp(argv[4], "steady")) {
        settle(&b, &run);
        return finish(&run, argv[2]);
    }
    SUNLinearSolver solver = SUNLinSol_SPGMR(run.state, SUN_PREC_LEFT, KRYLOV_VECTORS, run.context);
    check(CVodeSetLinearSolver(run.cvode, solver, NULL), "CVodeSetLinearSolver");
    check(CVodeSetJacTimes(run.cvode, NULL, times_jacobian), "CVodeSetJacTimes");
    check(CVodeSetPreconditioner(run.cvode, prepare, precondition), "CVodeSetPreconditioner");
    integrate(&run);
    return finish(&run, argv[2]);
}
