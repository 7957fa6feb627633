/* Launchers that start processes together: mpirun, srun. */
#ifndef BAYESOPT_TOOL_LAUNCHER_H
#define BAYESOPT_TOOL_LAUNCHER_H

/* Number of this process among those that a launcher started together; -1: none did. What an MPI
 * launcher has put into the environment for this process is taken out of it, so that evaluations
 * may be MPI programs, or call mpirun, themselves. */
long launcher_leave(void);

#endif
