#include "run_tool.h"

#include "check.h"

#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static const char *folder(void)
{
    static char name[200];
    if (!*name) {
        snprintf(name, sizeof name, "%s/test_galv_XXXXXX", check_scratch());
        if (!mkdtemp(name))
            abort();
    }
    return name;
}

const char *scratch(const char *name)
{
    static char path[300];
    snprintf(path, sizeof path, "%s/%s", folder(), name);
    return path;
}

static char *slurp(const char *path)
{
    FILE *stream = fopen(path, "rb");
    size_t length = 0, room = 1 << 16;
    char *text = malloc(room);
    while (stream && text) {
        length += fread(text + length, 1, room - length - 1, stream);
        if (feof(stream) || ferror(stream))
            break;
        if (room - length < 2)
            text = realloc(text, room *= 2);
    }
    if (stream)
        fclose(stream);
    if (!text)
        abort();
    text[length] = '\0';
    return text;
}

void scratch_write(const char *name, const char *text)
{
    FILE *stream = fopen(scratch(name), "w");
    if (!stream || fputs(text, stream) == EOF || fclose(stream) != 0)
        abort();
}

struct run run_tool(const char *arguments)
{
    char command[4096];
    snprintf(command, sizeof command, "cd %s && '%s' %s > stdout 2> stderr", folder(), GALV_TOOL,
             arguments);
    int status = system(command);
    struct run run = {.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1};
    run.output = slurp(scratch("stdout"));
    run.errors = slurp(scratch("stderr"));
    return run;
}

void run_free(struct run *run)
{
    free(run->output);
    free(run->errors);
}

json_t *run_json(const char *arguments)
{
    struct run run = run_tool(arguments);
    json_error_t error;
    json_t *root = json_loads(run.output, 0, &error);
    if (run.code != 0 || !root)
        fprintf(stderr, "galv %s: exit %d, %s%s\n", arguments, run.code, run.errors, error.text);
    CU_ASSERT_EQUAL(run.code, 0);
    CU_ASSERT_PTR_NOT_NULL_FATAL(root);
    run_free(&run);
    return root;
}

void scratch_remove_all(void)
{
    char command[240];
    snprintf(command, sizeof command, "rm -rf '%s'", folder());
    if (system(command) != 0)
        fprintf(stderr, "%s could not be removed\n", folder());
}
