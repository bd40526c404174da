/* A gearbox over a drive cycle that repeats: gears, oil, housing.
   C_0 T_0' = mu omega M - (T_0 - T_1) / R_0
   C_1 T_1' = churn n^(5/3) exp(-fall (T_1 - T_ref)) + (T_0 - T_1) / R_0 - (T_1 - T_2) / R_1
   C_2 T_2' = (T_1 - T_2) / R_1 - (h_0 + h_1 v^0.8) A (T_2 - T_air)
   Points of speed n, torque M and v are joined by straight lines. CVODE, a dense Jacobian; the run
   has no restarts, its steps are no longer than the distance of two points.
   cycle NET.BIN ROWS.BIN TOLERANCE run */
#include "laws.h"

typedef struct {
    const Net *net;
    const double *x; /* the numbers of the law, in the order below */
    const double *t, *speed, *torque, *v; /* s, rpm, N m, m/s */
    int points;
} Cycle;
enum { MU, CHURN, FALL, REFERENCE, R0, R1, H0, H1, AREA, AIR };

/* Points are evenly spaced. */
static int place(const Cycle *c, double t, double *share)
{
    double step = c->t[1], since = fmod(t, c->t[c->points - 1]) / step;
    int k = (int)since;
    *share = since - k;
    return k;
}

static double between(const double *y, int k, double share)
{
    return y[k] + share * (y[k + 1] - y[k]);
}

static int rate(double t, N_Vector T_, N_Vector rate_, void *data)
{
    const Cycle *c = data;
    const double *x = c->x, *T = N_VGetArrayPointer(T_), *C = c->net->array[3];
    double *rate = N_VGetArrayPointer(rate_), share;
    int k = place(c, t, &share);
    double n = between(c->speed, k, share), M = between(c->torque, k, share);
    double mesh = x[MU] * n * (2 * M_PI / 60) * M;
    double churn =
        x[CHURN] * pow(n, 5.0 / 3) * (x[FALL] ? exp(-x[FALL] * (T[1] - x[REFERENCE])) : 1);
    double h = x[H0] + x[H1] * pow(between(c->v, k, share), 0.8);
    double a = (T[0] - T[1]) / x[R0], b = (T[1] - T[2]) / x[R1];
    rate[0] = (mesh - a) / C[0];
    rate[1] = (churn + a - b) / C[1];
    rate[2] = (b - h * x[AREA] * (T[2] - x[AIR])) / C[2];
    return 0;
}

int main(int argc, char **argv)
{
    if (argc != 5)
        return 2;
    Net net = load_net(argv[1], argv[3]);
    double **a = net.array;
    Cycle cycle = {&net, a[0] + 3, a[4], a[5], a[6], a[7], (int)net.length[4]};
    Run run = begin(&net, rate, &cycle);
    SUNMatrix J = SUNDenseMatrix(3, 3, run.context);
    SUNLinearSolver solver = SUNLinSol_Dense(run.state, J, run.context);
    check(CVodeSetLinearSolver(run.cvode, solver, J), "CVodeSetLinearSolver");
    check(CVodeSetMaxStep(run.cvode, cycle.t[1]), "CVodeSetMaxStep");
    integrate(&run);
    return finish(&run, argv[2]);
}
