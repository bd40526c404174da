/* The steady state K T = heat of a linear network.
   steady NET.BIN ROWS.BIN chol_amd|chol_metis|klu|pcg_ic0 [RESIDUAL]
     chol_amd, chol_metis  CHOLMOD's Cholesky, supernodal where it chooses so, in AMD or METIS order
     klu                   KLU in AMD order
     pcg_ic0               conjugate gradients with incomplete Cholesky, to RESIDUAL or 1e-10
   ROWS.BIN receives the temperatures of the probes, float64; stdout one line of counts. */
#include "network.h"
#include <cholmod.h>
#include <klu.h>

#define MOST_ITERATIONS 20000

/* The lower triangle of K, which CHOLMOD reads by columns: the upper one of each row. */
static cholmod_sparse *lower_triangle(const Network *net, cholmod_common *common)
{
    int n = net->n;
    size_t entries = (net->begin[n] + (size_t)n) / 2;
    cholmod_sparse *A = cholmod_allocate_sparse(n, n, entries, 1, 1, -1, CHOLMOD_REAL, common);
    int *begin = A->p, *row = A->i, filled = 0;
    double *value = A->x;
    for (int j = 0; j < n; j++) {
        begin[j] = filled;
        for (int k = net->diagonal[j]; k < net->begin[j + 1]; k++) {
            row[filled] = net->column[k];
            value[filled++] = net->value[k];
        }
    }
    begin[n] = filled;
    return A;
}

static void by_cholmod(const Network *net, double *heat, double *T, int ordering)
{
    cholmod_common common;
    cholmod_start(&common);
    common.nmethods = 1;
    common.method[0].ordering = ordering;
    cholmod_sparse *A = lower_triangle(net, &common);
    cholmod_factor *L = cholmod_analyze(A, &common);
    cholmod_factorize(A, L, &common);
    if (common.status != CHOLMOD_OK)
        exit(1);
    size_t n = net->n;
    cholmod_dense b = {n, 1, n, n, heat, NULL, CHOLMOD_REAL, CHOLMOD_DOUBLE};
    cholmod_dense *x = cholmod_solve(CHOLMOD_A, L, &b, &common);
    memcpy(T, x->x, sizeof(double) * n);
    printf("fill=%.0f\n", common.lnz);
}

static void by_klu(Network *net, double *heat, double *T)
{
    klu_common common;
    klu_defaults(&common);
    klu_symbolic *symbolic = klu_analyze(net->n, net->begin, net->column, &common);
    klu_numeric *factor = klu_factor(net->begin, net->column, net->value, symbolic, &common);
    if (!factor)
        exit(1);
    memcpy(T, heat, sizeof(double) * net->n);
    klu_solve(symbolic, factor, net->n, 1, T, &common);
    printf("fill=%d\n", factor->lnz + factor->unz);
}

static double dot(const double *a, const double *b, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

static void by_conjugate_gradients(const Network *net, const double *heat, double *T,
                                   double residual)
{
    int n = net->n, iterations = 0;
    double *lower = doubles(net->begin[n]), *inverse = doubles(n);
    double *r = doubles(n), *z = doubles(n), *p = doubles(n), *Kp = doubles(n);
    incomplete_cholesky(net, 0, 1, lower, inverse);
    memcpy(r, heat, sizeof(double) * n);
    double enough = residual * residual * dot(heat, heat, n), rz = 0;
    for (; iterations < MOST_ITERATIONS && dot(r, r, n) > enough; iterations++) {
        apply_cholesky(net, lower, inverse, r, z);
        double before = rz;
        rz = dot(r, z, n);
        double keep = iterations ? rz / before : 0;
        for (int i = 0; i < n; i++)
            p[i] = z[i] + keep * p[i];
        multiply(net, p, Kp);
        double step = rz / dot(p, Kp, n);
        for (int i = 0; i < n; i++) {
            T[i] += step * p[i];
            r[i] -= step * Kp[i];
        }
    }
    printf("iterations=%d\n", iterations);
}

int main(int argc, char **argv)
{
    if (argc < 4) {
        fprintf(stderr, "steady NET.BIN ROWS.BIN chol_amd|chol_metis|klu|pcg_ic0 [RESIDUAL]\n");
        return 2;
    }
    Network net;
    load_network(&net, argv[1]);
    double *heat = doubles(net.n), *slope = doubles(net.n), *T = doubles(net.n);
    double *rows = doubles(net.n_probes);
    load_between(&net, 0, net.t_end, heat, slope);
    if (!strcmp(argv[3], "chol_amd"))
        by_cholmod(&net, heat, T, CHOLMOD_AMD);
    else if (!strcmp(argv[3], "chol_metis"))
        by_cholmod(&net, heat, T, CHOLMOD_METIS);
    else if (!strcmp(argv[3], "klu"))
        by_klu(&net, heat, T);
    else
        by_conjugate_gradients(&net, heat, T, argc > 4 ? atof(argv[4]) : 1e-10);
    for (int k = 0; k < net.n_probes; k++)
        rows[k] = T[net.probe[k]];
    write_doubles(argv[2], rows, net.n_probes);
    return 0;
}
