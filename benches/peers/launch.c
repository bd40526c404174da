/* Runs a program and tells what it took:
   launch SECONDS GIGABYTES REPORT STDOUT PROGRAM [ARGUMENT..]
   REPORT receives "status user system wall peak": s, and kB of memory. The program may take so many
   seconds of CPU and gigabytes of address space; it reads nothing, and says its errors on stderr.
   A program this small is between because a child counts its parent's memory until it is itself. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static double seconds(struct timeval t) { return t.tv_sec + 1e-6 * t.tv_usec; }

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

static void limit(int resource, double value)
{
    struct rlimit most = {(rlim_t)value, (rlim_t)value};
    setrlimit(resource, &most);
}

static void open_as(int descriptor, const char *path, int flags)
{
    int file = open(path, flags, 0644);
    if (file < 0 || dup2(file, descriptor) < 0) {
        perror(path);
        _exit(126);
    }
    close(file);
}

int main(int argc, char **argv)
{
    if (argc < 6)
        return 125;
    double begun = now();
    pid_t child = fork();
    if (child == 0) {
        limit(RLIMIT_CPU, atof(argv[1]));
        limit(RLIMIT_AS, atof(argv[2]) * (1 << 30));
        open_as(0, "/dev/null", O_RDONLY);
        open_as(1, argv[4], O_WRONLY | O_CREAT | O_TRUNC);
        execvp(argv[5], argv + 5);
        perror(argv[5]);
        _exit(127);
    }
    int status;
    struct rusage used;
    if (child < 0 || wait4(child, &status, 0, &used) < 0)
        return 125;
    FILE *report = fopen(argv[3], "w");
    if (!report)
        return 125;
    fprintf(report, "%d %.6f %.6f %.6f %ld\n", status, seconds(used.ru_utime),
            seconds(used.ru_stime), now() - begun, used.ru_maxrss);
    return fclose(report) ? 125 : 0;
}
