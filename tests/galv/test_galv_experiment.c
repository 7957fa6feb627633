/* The dimensionality reduction of the experiment: 9000 uniform samples of the 27 functions on the
 * DTMB 5415 hull give 15 modes with 95.2 % of the variance. */
#include "check.h"
#include "run_tool.h"

#include <string.h>

static void test_fifteen_modes(void)
{
    for (int seed = 1; seed <= 2; seed++) {
        char arguments[512];
        snprintf(arguments, sizeof arguments,
                 "reduce --hull '%s/hulls/dtmb5415.json' --shape '%s/dtmb5415_shape.yaml' "
                 "--random 9000 --seed %d --variance 0.95 --json",
                 EXAMPLES_DIR, EXAMPLES_DIR, seed);
        json_t *root = run_json(arguments);
        CU_ASSERT_EQUAL(json_integer_value(json_object_get(root, "samples")), 9000);
        CU_ASSERT_EQUAL(json_integer_value(json_object_get(root, "elements")), 2250);
        CU_ASSERT_EQUAL(json_integer_value(json_object_get(root, "modes")), 15);
        CHECK_CLOSE(json_number_value(json_object_get(root, "retained")), 0.952, 0.001);
        json_decref(root);
    }
    scratch_remove_all();
}

static const struct check_case cases[] = {{"9000 samples, 15 modes", test_fifteen_modes}};

CHECK_MAIN("galv experiment", cases)
