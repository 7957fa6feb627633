#include "launcher.h"

#include "cli.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

extern char **environ;

/* What mpirun of Open MPI and Hydra sets for a rank, by how the names begin. Options that a user
 * gives in the environment, OMPI_MCA_btl or OMPI_ALLOW_RUN_AS_ROOT, are not among them. */
static const char *const of_a_rank[] = {
    "OMPI_COMM_WORLD_",
    "OMPI_UNIVERSE_SIZE",
    "OMPI_APP_CTX_NUM_PROCS",
    "OMPI_FIRST_RANKS",
    "OMPI_NUM_APP_CTX",
    "OMPI_FILE_LOCATION",
    "OMPI_ARGV",
    "OMPI_COMMAND",
    "OMPI_MCA_ess",
    "OMPI_MCA_orte_",
    "OMPI_MCA_initial_wdir",
    "OMPI_MCA_pmix",
    "OMPI_MCA_shmem_",
    "PMIX_",
    "PMI_",
};

static bool is_of_a_rank(const char *entry)
{
    for (size_t i = 0; i < sizeof of_a_rank / sizeof *of_a_rank; i++)
        if (strncmp(entry, of_a_rank[i], strlen(of_a_rank[i])) == 0)
            return true;
    return false;
}

long launcher_leave(void)
{
    static const char *const variables[] = {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK",
                                            "SLURM_PROCID"};
    long rank = -1;
    for (size_t i = 0; i < sizeof variables / sizeof *variables && rank < 0; i++) {
        const char *text = getenv(variables[i]);
        size_t number;
        if (text && cli_parse_size(text, &number))
            rank = (long)number;
    }
    for (size_t i = 0; environ && environ[i];) {
        size_t length = strcspn(environ[i], "=");
        char name[256];
        if (!is_of_a_rank(environ[i]) || length >= sizeof name) {
            i++;
            continue;
        }
        memcpy(name, environ[i], length);
        name[length] = '\0';
        /* The entries behind it move up. */
        if (unsetenv(name))
            i++;
    }
    return rank;
}
