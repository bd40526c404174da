/* A row of rooms, each with a heater that a thermostat with a dead band switches; the outside
   temperature swings. C_i T_i' = on_i P_i + G (T_j - T_i) + G_out,i (T_out(t) - T_i). CVODE with a
   tridiagonal Jacobian; roots at the edges of the dead bands, a restart at each switch.
   thermostat NET.BIN ROWS.BIN TOLERANCE run */
#include "laws.h"

typedef struct {
    const Net *net;
    double along, mean, swing, period; /* W/K, degC, K, s */
    const double *C, *out, *P, *below, *above; /* J/K, W/K, W, degC, degC */
    int *on;
} Rooms;

static int rate(double t, N_Vector T_, N_Vector rate_, void *data)
{
    const Rooms *r = data;
    const double *T = N_VGetArrayPointer(T_);
    double *rate = N_VGetArrayPointer(rate_), flow = 0;
    double outside = r->mean + r->swing * sin(2 * M_PI * t / r->period);
    for (int i = 0; i < r->net->n; i++) {
        double on = i + 1 < r->net->n ? r->along * (T[i] - T[i + 1]) : 0;
        double heat = (r->on[i] ? r->P[i] : 0) + r->out[i] * (outside - T[i]);
        rate[i] = (heat + flow - on) / r->C[i];
        flow = on;
    }
    return 0;
}

static int jacobian(double t, N_Vector T, N_Vector rate_, SUNMatrix J, void *data, N_Vector a,
                    N_Vector b, N_Vector c)
{
    const Rooms *r = data;
    int n = r->net->n;
    for (int i = 0; i < n; i++) {
        SM_ELEMENT_B(J, i, i) = -(r->out[i] + r->along * ((i > 0) + (i + 1 < n))) / r->C[i];
        if (i > 0)
            SM_ELEMENT_B(J, i, i - 1) = r->along / r->C[i];
        if (i + 1 < n)
            SM_ELEMENT_B(J, i, i + 1) = r->along / r->C[i];
    }
    (void)t, (void)T, (void)rate_, (void)a, (void)b, (void)c;
    return 0;
}

static int edges(double t, N_Vector T_, double *distance, void *data)
{
    const Rooms *r = data;
    const double *T = N_VGetArrayPointer(T_);
    for (int i = 0; i < r->net->n; i++)
        distance[i] = T[i] - (r->on[i] ? r->above[i] : r->below[i]);
    (void)t;
    return 0;
}

static void run_and_switch(Run *run, Rooms *r)
{
    int n = r->net->n, *found = calloc(n, sizeof(int));
    double t;
    check(CVodeRootInit(run->cvode, n, edges), "CVodeRootInit");
    while (run->row < r->net->rows) {
        int flag = CVode(run->cvode, row_time(r->net, run->row), run->state, &t, CV_NORMAL);
        check(flag, "CVode");
        if (flag != CV_ROOT_RETURN) {
            keep_row(run);
            continue;
        }
        CVodeGetRootInfo(run->cvode, found);
        for (int i = 0; i < n; i++)
            r->on[i] ^= found[i] != 0;
        check(CVodeReInit(run->cvode, t, run->state), "CVodeReInit");
    }
}

int main(int argc, char **argv)
{
    if (argc != 5)
        return 2;
    Net net = load_net(argv[1], argv[3]);
    const double *x = net.array[0] + 3;
    double **a = net.array;
    Rooms r = {
        &net, x[0], x[1], x[2], x[3], a[3], a[4], a[5], a[6], a[7], calloc(net.n, sizeof(int))};
    for (int i = 0; i < net.n; i++)
        r.on[i] = (int)a[8][i];
    Run run = begin(&net, rate, &r);
    banded(&run, 1, jacobian);
    run_and_switch(&run, &r);
    return finish(&run, argv[2]);
}
