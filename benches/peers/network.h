/* Reads net.bin, which benches/forms.py writes, and assembles its conductances. */
#ifndef NETWORK_H
#define NETWORK_H
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ABSOLUTE_ZERO 273.15

typedef struct {
    int n, n_edges, n_rads, n_bounds, n_sources, n_points, n_probes, n_rows, n_events;
    double t_end;
    double *C, *T0;                       /* J/K, degC */
    double *G, *k_rad, *T_bound;          /* W/K, W/K^4, degC */
    double *point_t, *point_P;            /* corners of the sources: s, W */
    double *row_t, *event_t;              /* s */
    int *edge_i, *edge_j, *rad_i, *rad_j; /* ends; not below n: boundary with that number less n */
    int *source_node, *source_begin, *probe;
    /* the conductance matrix K, symmetric and positive definite, all of it, rows sorted; and the
       heat into each node from the boundaries at K's zero of temperature, 0 degC */
    int *begin, *column, *diagonal;
    double *value, *bound_load;
} Network;

static void *get_memory(size_t count, size_t size)
{
    void *memory = calloc(count ? count : 1, size);
    if (!memory) {
        fprintf(stderr, "out of memory\n");
        exit(4);
    }
    return memory;
}

static double *doubles(size_t count) { return get_memory(count, sizeof(double)); }
static int *integers(size_t count) { return get_memory(count, sizeof(int)); }

static char *read_whole(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        perror(path);
        exit(2);
    }
    fseek(file, 0, SEEK_END);
    size_t length = ftell(file);
    rewind(file);
    char *text = get_memory(length, 1);
    if (fread(text, 1, length, file) != length)
        exit(2);
    fclose(file);
    return text;
}

static void write_doubles(const char *path, const double *x, size_t count)
{
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(x, sizeof(double), count, file) != count || fclose(file))
        exit(3);
}

static double *take_doubles(char **at, int count)
{
    double *here = (double *)*at;
    *at += sizeof(double) * (size_t)count;
    return here;
}

static int *take_integers(char **at, int count)
{
    int *here = (int *)*at;
    *at += sizeof(int) * (size_t)count;
    return here;
}

static void read_network(Network *net, const char *path)
{
    char *at = read_whole(path);
    int64_t *head = (int64_t *)at;
    at += 12 * sizeof(int64_t);
    net->n = head[1];
    net->n_edges = head[2];
    net->n_rads = head[3];
    net->n_bounds = head[4];
    net->n_sources = head[5];
    net->n_points = head[6];
    net->n_probes = head[7];
    net->n_rows = head[8];
    net->n_events = head[9];
    net->t_end = *take_doubles(&at, 1);
    net->C = take_doubles(&at, net->n);
    net->T0 = take_doubles(&at, net->n);
    net->G = take_doubles(&at, net->n_edges);
    net->k_rad = take_doubles(&at, net->n_rads);
    net->T_bound = take_doubles(&at, net->n_bounds);
    net->point_t = take_doubles(&at, net->n_points);
    net->point_P = take_doubles(&at, net->n_points);
    net->row_t = take_doubles(&at, net->n_rows);
    net->event_t = take_doubles(&at, net->n_events);
    net->edge_i = take_integers(&at, net->n_edges);
    net->edge_j = take_integers(&at, net->n_edges);
    net->rad_i = take_integers(&at, net->n_rads);
    net->rad_j = take_integers(&at, net->n_rads);
    net->source_node = take_integers(&at, net->n_sources);
    net->source_begin = take_integers(&at, net->n_sources + 1);
    net->probe = take_integers(&at, net->n_probes);
}

/* Entries of a matrix in the order of the file; `count` of them. */
typedef struct {
    int count, *row, *column;
    double *value;
} Entries;

static void add_entry(Entries *e, int row, int column, double value)
{
    e->row[e->count] = row;
    e->column[e->count] = column;
    e->value[e->count++] = value;
}

/* Conductances, a zero for each radiating pair (its place in the Jacobian), the diagonal. */
static Entries list_entries(Network *net)
{
    int n = net->n;
    size_t most = n + 2 * ((size_t)net->n_edges + net->n_rads);
    Entries e = {0, integers(most), integers(most), doubles(most)};
    double *sum = doubles(n);
    for (int k = 0; k < net->n_edges; k++) {
        int i = net->edge_i[k], j = net->edge_j[k];
        sum[i] += net->G[k];
        if (j < n) {
            sum[j] += net->G[k];
            add_entry(&e, i, j, -net->G[k]);
            add_entry(&e, j, i, -net->G[k]);
        } else {
            net->bound_load[i] += net->G[k] * net->T_bound[j - n];
        }
    }
    for (int k = 0; k < net->n_rads; k++)
        if (net->rad_j[k] < n) {
            add_entry(&e, net->rad_i[k], net->rad_j[k], 0);
            add_entry(&e, net->rad_j[k], net->rad_i[k], 0);
        }
    for (int i = 0; i < n; i++)
        add_entry(&e, i, i, sum[i]);
    free(sum);
    return e;
}

/* A stable counting sort: `order` by `key`, which is below n. */
static int *sort_by(const int *key, const int *order, int count, int n)
{
    int *begin = integers(n + 1), *sorted = integers(count);
    for (int k = 0; k < count; k++)
        begin[key[k] + 1]++;
    for (int i = 0; i < n; i++)
        begin[i + 1] += begin[i];
    for (int k = 0; k < count; k++) {
        int entry = order ? order[k] : k;
        sorted[begin[key[entry]]++] = entry;
    }
    free(begin);
    return sorted;
}

static void assemble(Network *net)
{
    int n = net->n;
    net->bound_load = doubles(n);
    Entries e = list_entries(net);
    int *by_column = sort_by(e.column, NULL, e.count, n);
    int *order = sort_by(e.row, by_column, e.count, n);
    net->begin = integers(n + 1);
    net->diagonal = integers(n);
    net->column = integers(e.count);
    net->value = doubles(e.count);
    int filled = 0;
    for (int k = 0, row = -1; k < e.count; k++) {
        int entry = order[k], column = e.column[entry];
        int same_row = e.row[entry] == row;
        if (!same_row)
            net->begin[row = e.row[entry]] = filled; /* every row has its diagonal */
        if (same_row && net->column[filled - 1] == column) {
            net->value[filled - 1] += e.value[entry];
            continue;
        }
        if (column == row)
            net->diagonal[row] = filled;
        net->column[filled] = column;
        net->value[filled++] = e.value[entry];
    }
    net->begin[n] = filled;
    free(e.row);
    free(e.column);
    free(e.value);
    free(by_column);
    free(order);
}

static void load_network(Network *net, const char *path)
{
    read_network(net, path);
    assemble(net);
}

/* y = K x */
static void multiply(const Network *net, const double *x, double *y)
{
    for (int i = 0; i < net->n; i++) {
        double sum = 0;
        for (int k = net->begin[i]; k < net->begin[i + 1]; k++)
            sum += net->value[k] * x[net->column[k]];
        y[i] = sum;
    }
}

/* The heat of a source on the line through corners a and b. */
static double on_line(const Network *net, int a, int b, double t)
{
    double t0 = net->point_t[a], t1 = net->point_t[b], P0 = net->point_P[a], P1 = net->point_P[b];
    return t1 > t0 ? P0 + (P1 - P0) * (t - t0) / (t1 - t0) : P0;
}

/* The heat of source s just after t. */
static double heat_after(const Network *net, int s, double t)
{
    int first = net->source_begin[s], last = net->source_begin[s + 1] - 1, k = last;
    while (k > first && net->point_t[k] > t)
        k--;
    return k == last ? net->point_P[last] : on_line(net, k, k + 1, t);
}

/* The heat of source s just before t. */
static double heat_before(const Network *net, int s, double t)
{
    int first = net->source_begin[s], last = net->source_begin[s + 1] - 1, k = first;
    while (k < last && net->point_t[k] < t)
        k++;
    return k == first ? net->point_P[first] : on_line(net, k - 1, k, t);
}

/* From one event to the next heat is a straight line: load + (t - from) * slope. */
static void load_between(const Network *net, double from, double to, double *load, double *slope)
{
    memcpy(load, net->bound_load, sizeof(double) * net->n);
    memset(slope, 0, sizeof(double) * net->n);
    for (int s = 0; s < net->n_sources; s++) {
        double P0 = heat_after(net, s, from), P1 = heat_before(net, s, to);
        load[net->source_node[s]] += P0;
        slope[net->source_node[s]] += (P1 - P0) / (to - from);
    }
}

/* The incomplete factors L D L^T of shift * C + scale * K in K's own pattern and the natural order:
   L's strict lower part in `lower` at K's places, 1/D in `inverse`. A grid has no triangles, so
   that no product of two entries of L falls on a third. */
static void incomplete_cholesky(const Network *net, double shift, double scale, double *lower,
                                double *inverse)
{
    for (int i = 0; i < net->n; i++) {
        double pivot = shift * net->C[i] + scale * net->value[net->diagonal[i]];
        for (int k = net->begin[i]; k < net->diagonal[i]; k++) {
            double entry = scale * net->value[k];
            lower[k] = entry * inverse[net->column[k]];
            pivot -= entry * lower[k];
        }
        inverse[i] = 1 / pivot;
    }
}

/* z = (L D L^T)^-1 r */
static void apply_cholesky(const Network *net, const double *lower, const double *inverse,
                           const double *r, double *z)
{
    for (int i = 0; i < net->n; i++) {
        double sum = r[i];
        for (int k = net->begin[i]; k < net->diagonal[i]; k++)
            sum -= lower[k] * z[net->column[k]];
        z[i] = sum;
    }
    for (int i = 0; i < net->n; i++)
        z[i] *= inverse[i];
    for (int i = net->n - 1; i >= 0; i--)
        for (int k = net->begin[i]; k < net->diagonal[i]; k++)
            z[net->column[k]] -= lower[k] * z[i];
}
#endif
