/* Numbers in the output of programs: what is read, and what is refused. */
#include "check.h"
#include "result.h"

#include <math.h>
#include <string.h>

static char reason[400];

static double read_key(const char *text, const char *key, enum result_match match)
{
    double value = -1;
    reason[0] = '\0';
    return result_find(text, key, match, 1, &value, reason, sizeof reason) ? value : -777;
}

static double cw(const char *text)
{
    return read_key(text, "Cw", RESULT_EQUAL);
}

static int refused(const char *text, const char *sentence)
{
    int ok = cw(text) == -777 && strstr(reason, sentence) != NULL;
    if (!ok)
        fprintf(stderr, "'%s': reason '%s', expected '%s'\n", text, reason, sentence);
    return ok;
}

static void forms_of_statements(void)
{
    static const char *const forms[] = {
        "Cw = 6.5",        "Cw=6.5\n",
        "Cw: 6.5",         "Cw 6.5",
        "  Cw\t6.5 m/s",   "Cw,6.5",
        "Cw, 6.5, ok",     "| Cw | 6.5 |",
        "|Cw|6.5|",        "Cw [kN]: 6.5",
        "Cw [kN] 6.5",     "Cw (1) = 6.5",
        "Cw [-] = 6.5 .",  "Cw(kN)=6.5",
        "{\"Cw\": 6.5}",   "{\"a\":1,\"Cw\":6.5,\"b\":2}",
        "'Cw': '6.5'",     "Cw := 6.5;",
        "total: Cw = 6.5", "[\"Cw\", 6.5]",
        "Cw = 6.5 +- 0.1", "Cw = [6.5]",
        "Cw = +.65d+1",    "Cw\r\nCw = 6.5\r\n",
        "a Cw:\nCw = 6.5", "Cwmax = 3\nCw = 6.5\nmaxCw = 2\nCw_0 = 1"};
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        if (cw(forms[i]) != 6.5)
            fprintf(stderr, "'%s' is read as %g (%s)\n", forms[i], cw(forms[i]), reason);
        CU_ASSERT(cw(forms[i]) == 6.5);
    }
}

static void fortran(void)
{
    CHECK_CLOSE(cw("Cw = 1.5D-03"), 0.0015, 0);
    CHECK_CLOSE(cw("Cw = 1.5d-03"), 0.0015, 0);
    CHECK_CLOSE(cw("Cw = -1.5Q2"), -150, 0);
    CHECK_CLOSE(cw("Cw = 1.5-103"), 1.5e-103, 0);
    CHECK_CLOSE(cw("Cw = 0.15+104"), 0.15e104, 0);
    CU_ASSERT(refused("Cw = ********", "'Cw = ********'"));
    CU_ASSERT(refused("Cw = 1.5D", "'Cw = 1.5D'"));
    CU_ASSERT(refused("Cw = 1.5-3", "'Cw = 1.5-3'"));
    CU_ASSERT(refused("Cw = 15-103", "'Cw = 15-103'"));
}

static void whole_words(void)
{
    static const char *const bad[] = {"Cw = 1,5",   "Cw = 1.234,5", "Cw = 3x",      "Cw = 4.5kN",
                                      "Cw = 12:30", "Cw = 1.2.3",   "Cw = 0x1p3",   "Cw = 3%",
                                      "Cw = e5",    "Cw = -",       "Cw = .",       "Cw: diverged",
                                      "Cw | ? |",   "Cw 1,5",       "Cw = 1e5e5",   "Cw = --3",
                                      "Cw = 1'000", "Cw = 3-4",     "Cw = \"3\"x\""};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        CU_ASSERT(refused(bad[i], bad[i]));
    CU_ASSERT(isnan(cw("Cw = NaN")));
    CU_ASSERT(isnan(cw("Cw = -nan")));
    CU_ASSERT(isinf(cw("Cw = Infinity")));
    CU_ASSERT(refused("", "no number after Cw in the output"));
    CU_ASSERT(refused("Cw history written to cw.dat", "no number after Cw in the output"));
}

static void several_statements(void)
{
    const char *prose = "Cw = 3\nCw history written to cw.dat\nCw, as said, is small\n";
    const char *differing = "Cw = 3\niteration 2\nCw = 2.5\n", *late = "Cw = 3\nCw = diverged\n";
    CHECK_CLOSE(cw(prose), 3, 0);
    CHECK_CLOSE(cw("Cw = 3\nCw: 3.0\n"), 3, 0);
    CU_ASSERT(refused(differing, "differs between 'Cw = 3' and 'Cw = 2.5'"));
    CHECK_CLOSE(read_key(differing, "Cw", RESULT_FIRST), 3, 0);
    CHECK_CLOSE(read_key(differing, "Cw", RESULT_LAST), 2.5, 0);
    CU_ASSERT(refused(late, "'Cw = diverged'"));
    CHECK_CLOSE(read_key(late, "Cw", RESULT_FIRST), 3, 0);
    CHECK_CLOSE(read_key(late, "Cw", RESULT_LAST), -777, 0);
    CHECK_CLOSE(read_key("Cw = ...\nCw = 4\n", "Cw", RESULT_LAST), 4, 0);
    CU_ASSERT(refused("Cw = 3\nCw = nan\n", "differs"));
}

static int list(const char *text, size_t n, double *values)
{
    reason[0] = '\0';
    return result_find(text, "df", RESULT_EQUAL, n, values, reason, sizeof reason);
}

static void lists(void)
{
    static const char *const good[] = {"df: [1, 2]",          "df = 1 2",           "df 1 2",
                                       "{\"df\": [1.0,2]}",   "df: 1, 2",           "df=1,2",
                                       "{\"df\":[\n1,\n2\n]", "df [1, 2]",          "df [N] 1 2",
                                       "| df | 1.0D0 | 2 |",  "df [N/m]: (1e0; 2)", "df = 1;2"};
    double v[3];
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        int ok = list(good[i], 2, v);
        if (!ok || v[0] != 1 || v[1] != 2)
            fprintf(stderr, "'%s': %d (%s)\n", good[i], ok, reason);
        CU_ASSERT(ok && v[0] == 1 && v[1] == 2);
    }
    CU_ASSERT(!list("df = 1 2 3", 2, v));
    CU_ASSERT(!list("df = 1", 2, v) && strstr(reason, "not 2 numbers after df"));
    CU_ASSERT(!list("df = [1]\n2", 2, v));
    CU_ASSERT(!list("df = 0,5 0,7", 2, v));
    CU_ASSERT(!list("df = 1 x", 2, v));
}

static double last(const char *text)
{
    double value = -1;
    reason[0] = '\0';
    return result_last(text, &value, reason, sizeof reason) ? value : -777;
}

static void without_key(void)
{
    CHECK_CLOSE(last("2.5\n"), 2.5, 0);
    CHECK_CLOSE(last("start\nf = 1.5D-03 \n\n"), 0.0015, 0);
    CHECK_CLOSE(last("f=4"), 4, 0);
    CHECK_CLOSE(last("| f | -4 |"), -4, 0);
    CHECK_CLOSE(last("{\"f\": 4}"), 4, 0);
    CHECK_CLOSE(last("4.5\ndone\n"), -777, 0);
    CU_ASSERT(strstr(reason, "no number at the end of the last line, 'done'") != NULL);
    CHECK_CLOSE(last("4.5\nwritten to cw.dat2\n"), -777, 0);
    CHECK_CLOSE(last("1,5\n"), -777, 0);
    CHECK_CLOSE(last(" \n"), -777, 0);
    CU_ASSERT(strstr(reason, "empty") != NULL);
}

static const struct check_case cases[] = {
    {"forms of statements", forms_of_statements},
    {"exponents of Fortran", fortran},
    {"a number is a whole word", whole_words},
    {"several statements", several_statements},
    {"lists", lists},
    {"without a key", without_key},
};

CHECK_MAIN("results", cases)
