/* A rod that melts from a heated end, as a front: the state is the enthalpy of a node in K of its
   solid (H / C), h_i' = (P_i + sum (T_j - T_i) G) / C. Between solidus and liquidus T rises by
   (liquidus - solidus) while h rises by that and L / cp. CVODE with a tridiagonal Jacobian.
   melting NET.BIN ROWS.BIN TOLERANCE run */
#include "laws.h"

typedef struct {
    const Net *net;
    double C, along, solidus, liquidus, latent; /* J/K, W/K, degC, degC, K (latent heat / cp) */
    const double *P;
    double *T;
} Rod;

static double temperature(const Net *net, int node, double h)
{
    double solidus = net->array[0][5], liquidus = net->array[0][6], latent = net->array[0][7];
    double width = liquidus - solidus;
    (void)node;
    if (h <= solidus)
        return h;
    if (h >= liquidus + latent)
        return h - latent;
    return solidus + (h - solidus) * width / (width + latent);
}

/* dT/dh */
static double share(const Rod *rod, double h)
{
    double width = rod->liquidus - rod->solidus;
    return h <= rod->solidus || h >= rod->liquidus + rod->latent ? 1
                                                                 : width / (width + rod->latent);
}

static int rate(double t, N_Vector h_, N_Vector rate_, void *data)
{
    const Rod *rod = data;
    const double *h = N_VGetArrayPointer(h_);
    double *rate = N_VGetArrayPointer(rate_), flow = 0;
    int n = rod->net->n;
    for (int i = 0; i < n; i++)
        rod->T[i] = temperature(rod->net, i, h[i]);
    for (int i = 0; i < n; i++) {
        double on = i + 1 < n ? rod->along * (rod->T[i] - rod->T[i + 1]) : 0;
        rate[i] = (rod->P[i] + flow - on) / rod->C;
        flow = on;
    }
    (void)t;
    return 0;
}

static int jacobian(double t, N_Vector h_, N_Vector rate_, SUNMatrix J, void *data, N_Vector a,
                    N_Vector b, N_Vector c)
{
    const Rod *rod = data;
    const double *h = N_VGetArrayPointer(h_);
    int n = rod->net->n;
    for (int i = 0; i < n; i++) {
        double answer = rod->along * share(rod, h[i]) / rod->C;
        SM_ELEMENT_B(J, i, i) = -answer * ((i > 0) + (i + 1 < n));
        if (i > 0)
            SM_ELEMENT_B(J, i - 1, i) = answer;
        if (i + 1 < n)
            SM_ELEMENT_B(J, i + 1, i) = answer;
    }
    (void)t, (void)rate_, (void)a, (void)b, (void)c;
    return 0;
}

int main(int argc, char **argv)
{
    if (argc != 5)
        return 2;
    Net net = load_net(argv[1], argv[3]);
    const double *x = net.array[0] + 3;
    Rod rod = {&net, x[0], x[1], x[2], x[3], x[4], net.array[3], doubles(net.n)};
    Run run = begin(&net, rate, &rod);
    run.temperature = temperature;
    banded(&run, 1, jacobian);
    integrate(&run);
    return finish(&run, argv[2]);
}
