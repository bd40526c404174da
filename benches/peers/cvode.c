/* CVODE's BDF on net.bin as one would write it by hand: exact Jacobian, a restart at every event.
   cvode NET.BIN ROWS.BIN TOLERANCE klu|spgmr
     klu    direct, KLU in AMD order (SUNDIALS' own default, COLAMD, takes up to four times as long)
     spgmr  Krylov, with the incomplete Cholesky factors of C + gamma K; networks without radiation
   TOLERANCE is both the relative tolerance and the absolute one in K. ROWS.BIN receives the
   temperatures of the probes at every row, float64; stdout one line of counts. */
#include "network.h"
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunlinsol/sunlinsol_spgmr.h>
#include <sunmatrix/sunmatrix_sparse.h>

#define KRYLOV_VECTORS 30
#define AMD 0

typedef struct {
    Network net;
    double from; /* the event that the heats below count from, s */
    double *load, *slope, *inverse_C;
    int *rad_ij, *rad_ji;          /* where the Jacobian holds a pair that radiates */
    double *lower, *inverse_pivot; /* the preconditioner */
} Problem;

static void check(int flag, const char *what)
{
    if (flag < 0) {
        fprintf(stderr, "%s failed: %d\n", what, flag);
        exit(1);
    }
}

static double cube(double x) { return x * x * x; }
static double fourth(double x) { return x * x * x * x; }

/* dT/dt */
static int rate(sunrealtype t, N_Vector T_, N_Vector rate_, void *data)
{
    Problem *p = data;
    const Network *net = &p->net;
    const double *T = N_VGetArrayPointer(T_);
    double *dT = N_VGetArrayPointer(rate_), since = t - p->from;
    for (int i = 0; i < net->n; i++) {
        double heat = p->load[i] + since * p->slope[i];
        for (int k = net->begin[i]; k < net->begin[i + 1]; k++)
            heat -= net->value[k] * T[net->column[k]];
        dT[i] = heat;
    }
    for (int k = 0; k < net->n_rads; k++) {
        int i = net->rad_i[k], j = net->rad_j[k], inside = j < net->n;
        double Tj = inside ? T[j] : net->T_bound[j - net->n];
        double heat = net->k_rad[k] * (fourth(T[i] + ABSOLUTE_ZERO) - fourth(Tj + ABSOLUTE_ZERO));
        dT[i] -= heat;
        if (inside)
            dT[j] += heat;
    }
    for (int i = 0; i < net->n; i++)
        dT[i] *= p->inverse_C[i];
    return 0;
}

/* d(dT/dt)/dT. Its pattern is K's, which is symmetric, so that rows and columns share it. */
static int jacobian(sunrealtype t, N_Vector T_, N_Vector rate_, SUNMatrix J, void *data, N_Vector a,
                    N_Vector b, N_Vector c)
{
    Problem *p = data;
    const Network *net = &p->net;
    const double *T = N_VGetArrayPointer(T_);
    sunindextype *begin = SUNSparseMatrix_IndexPointers(J);
    sunindextype *row = SUNSparseMatrix_IndexValues(J);
    double *value = SUNSparseMatrix_Data(J);
    int entries = net->begin[net->n];
    for (int i = 0; i <= net->n; i++)
        begin[i] = net->begin[i];
    for (int k = 0; k < entries; k++) {
        row[k] = net->column[k];
        value[k] = -net->value[k];
    }
    for (int k = 0; k < net->n_rads; k++) {
        int i = net->rad_i[k], j = net->rad_j[k];
        double slope_i = 4 * net->k_rad[k] * cube(T[i] + ABSOLUTE_ZERO);
        value[net->diagonal[i]] -= slope_i;
        if (j < net->n) {
            double slope_j = 4 * net->k_rad[k] * cube(T[j] + ABSOLUTE_ZERO);
            value[net->diagonal[j]] -= slope_j;
            value[p->rad_ij[k]] += slope_i;
            value[p->rad_ji[k]] += slope_j;
        }
    }
    for (int k = 0; k < entries; k++)
        value[k] *= p->inverse_C[row[k]];
    (void)t, (void)rate_, (void)a, (void)b, (void)c;
    return 0;
}

static int times_jacobian(N_Vector v_, N_Vector Jv_, sunrealtype t, N_Vector T, N_Vector rate_,
                          void *data, N_Vector scratch)
{
    Problem *p = data;
    double *Jv = N_VGetArrayPointer(Jv_);
    multiply(&p->net, N_VGetArrayPointer(v_), Jv);
    for (int i = 0; i < p->net.n; i++)
        Jv[i] *= -p->inverse_C[i];
    (void)t, (void)T, (void)rate_, (void)scratch;
    return 0;
}

static int prepare(sunrealtype t, N_Vector T, N_Vector rate_, sunbooleantype jok,
                   sunbooleantype *renewed, sunrealtype gamma, void *data)
{
    Problem *p = data;
    incomplete_cholesky(&p->net, 1, gamma, p->lower, p->inverse_pivot);
    *renewed = !jok;
    (void)t, (void)T, (void)rate_;
    return 0;
}

/* (I + gamma C^-1 K) z = r, with C in front of both sides */
static int precondition(sunrealtype t, N_Vector T, N_Vector rate_, N_Vector r_, N_Vector z_,
                        sunrealtype gamma, sunrealtype delta, int side, void *data)
{
    Problem *p = data;
    double *r = N_VGetArrayPointer(r_), *z = N_VGetArrayPointer(z_);
    for (int i = 0; i < p->net.n; i++)
        z[i] = r[i] * p->net.C[i];
    apply_cholesky(&p->net, p->lower, p->inverse_pivot, z, z);
    (void)t, (void)T, (void)rate_, (void)gamma, (void)delta, (void)side;
    return 0;
}

/* Where column `column` of K has its entry in row `row`. */
static int find(const Network *net, int column, int row)
{
    int low = net->begin[column], high = net->begin[column + 1] - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        if (net->column[middle] < row)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static void prepare_problem(Problem *p, const char *path)
{
    Network *net = &p->net;
    load_network(net, path);
    p->load = doubles(net->n);
    p->slope = doubles(net->n);
    p->inverse_C = doubles(net->n);
    p->lower = doubles(net->begin[net->n]);
    p->inverse_pivot = doubles(net->n);
    p->rad_ij = integers(net->n_rads);
    p->rad_ji = integers(net->n_rads);
    for (int i = 0; i < net->n; i++)
        p->inverse_C[i] = 1 / net->C[i];
    for (int k = 0; k < net->n_rads; k++)
        if (net->rad_j[k] < net->n) {
            p->rad_ij[k] = find(net, net->rad_i[k], net->rad_j[k]);
            p->rad_ji[k] = find(net, net->rad_j[k], net->rad_i[k]);
        }
}

static void choose_solver(void *cvode, Problem *p, N_Vector T, int krylov, SUNContext context)
{
    if (krylov) {
        SUNLinearSolver solver = SUNLinSol_SPGMR(T, SUN_PREC_LEFT, KRYLOV_VECTORS, context);
        check(CVodeSetLinearSolver(cvode, solver, NULL), "CVodeSetLinearSolver");
        check(CVodeSetJacTimes(cvode, NULL, times_jacobian), "CVodeSetJacTimes");
        check(CVodeSetPreconditioner(cvode, prepare, precondition), "CVodeSetPreconditioner");
        return;
    }
    int n = p->net.n;
    SUNMatrix J = SUNSparseMatrix(n, n, p->net.begin[n], CSC_MAT, context);
    jacobian(0, T, NULL, J, p, NULL, NULL, NULL);
    SUNLinearSolver solver = SUNLinSol_KLU(T, J, context);
    SUNLinSol_KLUSetOrdering(solver, AMD);
    check(CVodeSetLinearSolver(cvode, solver, J), "CVodeSetLinearSolver");
    check(CVodeSetJacFn(cvode, jacobian), "CVodeSetJacFn");
}

/* Counts of the run: CVODE begins anew with every restart. */
typedef struct {
    long steps, rates, setups, newton, krylov;
} Counts;

static void count(void *cvode, Counts *counts)
{
    long steps, rates, setups, newton, krylov;
    CVodeGetNumSteps(cvode, &steps);
    CVodeGetNumRhsEvals(cvode, &rates);
    CVodeGetNumLinSolvSetups(cvode, &setups);
    CVodeGetNumNonlinSolvIters(cvode, &newton);
    CVodeGetNumLinIters(cvode, &krylov);
    counts->steps += steps;
    counts->rates += rates;
    counts->setups += setups;
    counts->newton += newton;
    counts->krylov += krylov;
}

/* Integrates from one event to the next and keeps the rows between; the number of rows so far. */
static int segment(void *cvode, Problem *p, N_Vector T, double end, int row, double *rows)
{
    const Network *net = &p->net;
    double t = p->from;
    load_between(net, p->from, end, p->load, p->slope);
    check(CVodeReInit(cvode, p->from, T), "CVodeReInit");
    check(CVodeSetStopTime(cvode, end), "CVodeSetStopTime");
    while (row < net->n_rows && net->row_t[row] <= end * (1 + 1e-14)) {
        check(CVode(cvode, fmin(net->row_t[row], end), T, &t, CV_NORMAL), "CVode");
        for (int k = 0; k < net->n_probes; k++)
            rows[(size_t)row * net->n_probes + k] = N_VGetArrayPointer(T)[net->probe[k]];
        row++;
    }
    if (t < end)
        check(CVode(cvode, end, T, &t, CV_NORMAL), "CVode");
    return row;
}

int main(int argc, char **argv)
{
    if (argc != 5) {
        fprintf(stderr, "cvode NET.BIN ROWS.BIN TOLERANCE klu|spgmr\n");
        return 2;
    }
    Problem p;
    Counts counts = {0};
    SUNContext context;
    double tolerance = atof(argv[3]);
    prepare_problem(&p, argv[1]);
    const Network *net = &p.net;
    SUNContext_Create(SUN_COMM_NULL, &context);
    N_Vector T = N_VNew_Serial(net->n, context);
    memcpy(N_VGetArrayPointer(T), net->T0, sizeof(double) * net->n);
    void *cvode = CVodeCreate(CV_BDF, context);
    check(CVodeInit(cvode, rate, 0, T), "CVodeInit");
    check(CVodeSetUserData(cvode, &p), "CVodeSetUserData");
    check(CVodeSStolerances(cvode, tolerance, tolerance), "CVodeSStolerances");
    check(CVodeSetMaxNumSteps(cvode, 10000000), "CVodeSetMaxNumSteps");
    choose_solver(cvode, &p, T, !strcmp(argv[4], "spgmr"), context);
    double *rows = doubles((size_t)net->n_rows * net->n_probes);
    for (int e = 0, row = 0; e < net->n_events; e++) {
        p.from = net->event_t[e];
        row = segment(cvode, &p, T, e + 1 < net->n_events ? net->event_t[e + 1] : net->t_end, row,
                      rows);
        count(cvode, &counts);
    }
    write_doubles(argv[2], rows, (size_t)net->n_rows * net->n_probes);
    printf("steps=%ld rates=%ld setups=%ld newton=%ld krylov=%ld\n", counts.steps, counts.rates,
           counts.setups, counts.newton, counts.krylov);
    return 0;
}
