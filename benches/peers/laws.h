/* What the programs for networks with laws over temperature or time share: reading net.bin as
   benches/laws.py writes it, CVODE, and the rows. Temperatures in degC. */
#ifndef LAWS_H
#define LAWS_H
#include <cvode/cvode.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sunlinsol/sunlinsol_band.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunlinsol/sunlinsol_spgmr.h>
#include <sunmatrix/sunmatrix_band.h>
#include <sunmatrix/sunmatrix_dense.h>

#ifndef SUN_COMM_NULL /* SUNDIALS 6 */
#define SUN_COMM_NULL NULL
#endif

/* Array 0: t_end in s, number of rows, number of nodes, then numbers of the family. Array 1:
   numbers of the probes. Array 2: temperatures at the start. The others are the family's. */
typedef struct {
    int count;
    int64_t *length;
    double **array;
    double t_end, tolerance;
    int rows, n, probes;
} Net;

static double *doubles(size_t count)
{
    double *memory = calloc(count ? count : 1, sizeof(double));
    if (!memory) {
        fprintf(stderr, "out of memory\n");
        exit(4);
    }
    return memory;
}

static void check(int flag, const char *name)
{
    if (flag < 0) {
        fprintf(stderr, "%s failed: %d\n", name, flag);
        exit(1);
    }
}

static void read_exactly(FILE *file, void *to, size_t size, size_t count)
{
    if (fread(to, size, count, file) != count) {
        fprintf(stderr, "net.bin ends too early\n");
        exit(2);
    }
}

static Net load_net(const char *path, const char *tolerance)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        perror(path);
        exit(2);
    }
    int64_t count;
    read_exactly(file, &count, sizeof count, 1);
    Net net = {(int)count, calloc(count, sizeof(int64_t)), calloc(count, sizeof(double *))};
    read_exactly(file, net.length, sizeof(int64_t), count);
    for (int k = 0; k < net.count; k++) {
        net.array[k] = doubles(net.length[k]);
        read_exactly(file, net.array[k], sizeof(double), net.length[k]);
    }
    fclose(file);
    net.t_end = net.array[0][0];
    net.rows = (int)net.array[0][1];
    net.n = (int)net.array[0][2];
    net.probes = (int)net.length[1];
    net.tolerance = atof(tolerance);
    return net;
}

/* A run: the state, CVODE on it, and the rows that are kept so far. `temperature` maps a state to
   the temperature of a node; NULL if the state is the temperature. */
typedef struct {
    const Net *net;
    SUNContext context;
    N_Vector state;
    void *cvode;
    double (*temperature)(const Net *net, int node, double state);
    double *kept;
    int row;
} Run;

static Run begin(const Net *net, CVRhsFn rate, void *data)
{
    Run run = {net};
    SUNContext_Create(SUN_COMM_NULL, &run.context);
    run.state = N_VNew_Serial(net->n, run.context);
    memcpy(N_VGetArrayPointer(run.state), net->array[2], sizeof(double) * net->n);
    run.cvode = CVodeCreate(CV_BDF, run.context);
    check(CVodeInit(run.cvode, rate, 0, run.state), "CVodeInit");
    check(CVodeSetUserData(run.cvode, data), "CVodeSetUserData");
    check(CVodeSStolerances(run.cvode, net->tolerance, net->tolerance), "CVodeSStolerances");
    check(CVodeSetMaxNumSteps(run.cvode, 100000000), "CVodeSetMaxNumSteps");
    run.kept = doubles((size_t)net->rows * net->probes);
    return run;
}

/* inline: not every program uses it */
static inline void banded(Run *run, int width, CVLsJacFn jacobian)
{
    SUNMatrix J = SUNBandMatrix(run->net->n, width, width, run->context);
    SUNLinearSolver solver = SUNLinSol_Band(run->state, J, run->context);
    check(CVodeSetLinearSolver(run->cvode, solver, J), "CVodeSetLinearSolver");
    if (jacobian)
        check(CVodeSetJacFn(run->cvode, jacobian), "CVodeSetJacFn");
}

static double row_time(const Net *net, int row) { return net->t_end * (row + 1) / net->rows; }

static void keep_row(Run *run)
{
    const Net *net = run->net;
    double *x = N_VGetArrayPointer(run->state), *row = run->kept + (size_t)run->row * net->probes;
    for (int k = 0; k < net->probes; k++) {
        int node = (int)net->array[1][k];
        row[k] = run->temperature ? run->temperature(net, node, x[node]) : x[node];
    }
    run->row++;
}

/* Integrates to the end of the run and keeps every row. */
static inline void integrate(Run *run)
{
    double t;
    while (run->row < run->net->rows) {
        double to = row_time(run->net, run->row);
        check(CVode(run->cvode, to, run->state, &t, CV_NORMAL), "CVode");
        keep_row(run);
    }
}

static int finish(Run *run, const char *path)
{
    long steps, rates;
    size_t count = (size_t)run->row * run->net->probes;
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(run->kept, sizeof(double), count, file) != count || fclose(file))
        return 3;
    CVodeGetNumSteps(run->cvode, &steps);
    CVodeGetNumRhsEvals(run->cvode, &rates);
    printf("steps=%ld rates=%ld\n", steps, rates);
    return 0;
}
#endif
