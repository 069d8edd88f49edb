#include <gtest/gtest.h>

#include <string>

#include "tests/engine/scene/scene_mistakes.h"
#include "tests/engine/scene/two_bodies_sample.h"

namespace burnish {
namespace {

using namespace samples;

const std::string functions = "functions: [49, 25]";

const std::string stripes = R"(geometry:
  shape: control-net
  degrees: [1, 1]
  knots: [[0, 0, 1, 2, 2], [0, 0, 1, 1]]
  points: [[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1]]
  refine: [2, 2]
material: {law: neo-hookean, E: 1, nu: 0.3}
steps: [{until: 1, count: 1}]
)";

const std::string pairOfPatches = R"(patches:
    - {name: a, shape: rectangle, size: [1, 1], spans: [2, 2]}
    - {name: b, shape: rectangle, origin: [1, 0], size: [1, 1], spans: [2, 2]}
)";
const std::string pair = "geometry:\n  shape: patches\n  " + pairOfPatches +
                         "material: {law: neo-hookean, E: 1, nu: 0.3}\nsteps: [{until: 1, count: 1}]\n";

/// In place of "supports:".
std::string thirdBody(const std::string& name) {
  return "  - {name: " + name +
         ", geometry: {shape: rectangle, size: [1, 1], spans: [1, 1]}, material: {law: neo-hookean, E: 1, nu: "
         "0.3}}\nsupports:";
}

class SceneMistake : public testing::TestWithParam<Mistake> {};

const std::string solid =
    "degree: 2\ngeometry: {shape: box, size: [1, 1, 1], spans: [2, 2, 2]}\n"
    "material: {law: neo-hookean, E: 1, nu: 0.3}\nsteps: [{until: 1, count: 1}]\n";
const std::string kBox = "shape: box, size: [1, 1, 1]";

TEST_P(SceneMistake, isReportedWithPlaceKeyAndRemedy) {
  expectReported(GetParam(), [](const std::string& yaml) { return errorOf(yaml); });
}

INSTANTIATE_TEST_SUITE_P(
    Keys, SceneMistake,
    testing::Values(
        Mistake{"unknownInside", &block, "nu: 0.3", "nu: 0.3, poisson: 1", "poisson", "material.poisson",
                "found an unknown key; allowed: law, E, nu, volumetric."},
        Mistake{"ofAnotherAlternative", &block, "origin: [0, 2]", "origin: [0, 2], radius: 1", "radius",
                "tools[1].radius",
                "found an unknown key; allowed: name, shape, origin, normal, inside, pivot, pivot_axis, "
                "motion, prescribe, path, carry, until, released_by."},
        Mistake{"duplicate", &block, "nu: 0.3", "nu: 0.3, E: 2", "E: 2", "material.E",
                "the key is already given in line 4"},
        Mistake{"missing", &block, "radius: 0.5, ", "", "{name: cylinder", "tools[0].radius",
                "missing; required: a number above 0."},
        Mistake{"missingTop", &block, "steps:\n  - {until: 1, count: 20}\n  - {until: 2, count: 200}\n", "",
                "basis: nurbs", "steps", "missing; required: a list of 1 or more mappings."},
        Mistake{"missingChoice", &block, "law: neo-hookean, ", "", "{E: 1.0", "material.law",
                "missing; required: neo-hookean | j2 | chaboche | mooney-rivlin | yeoh | ogden."}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Types, SceneMistake,
    testing::Values(
        Mistake{"textForNumber", &block, "E: 1.0", "E: soft", "soft", "material.E",
                "found soft; allowed: a number above 0."},
        Mistake{"quotedNumber", &block, "E: 1.0", "E: \"1.0\"", "\"1.0", "material.E",
                "found the text \"1.0\"; allowed: a number above 0."},
        Mistake{"numberWithUnit", &block, "radius: 0.5", "radius: 5 mm", "5 mm", "tools[0].radius",
                "found 5 mm; allowed: a number above 0."},
        Mistake{"nothing", &block, "E: 1.0", "E: ", ", nu", "material.E",
                "found nothing; allowed: a number above 0."},
        Mistake{"emptyMapping", &block, "steps:", "solver:\nsteps:", "steps", "solver",
                "found nothing; allowed: a mapping."},
        Mistake{"fraction", &block, "degree: 2", "degree: 2.5", "2.5", "degree",
                "found 2.5; allowed: a whole number from 1 to 10."},
        Mistake{"hugeInteger", &block, "count: 20}", "count: 99999999999}", "9", "steps[0].count",
                "found 99999999999; allowed: a whole number from 1 to 1000000."},
        Mistake{"infinite", &block, "E: 1.0", "E: .inf", ".inf", "material.E",
                "found .inf; allowed: a number above 0 that is finite"},
        Mistake{"notANumber", &block, "traction: [1, 0]", "traction: [1, .nan]", ".nan",
                "loads[0].traction[1]", "the formula \".nan\" cannot be understood"},
        Mistake{"decimalComma", &block, "material: {law: neo-hookean, E: 1.0, nu: 0.3}",
                "material:\n  law: neo-hookean\n  E: 1.0\n  nu: 0,3", "0,3", "material.nu",
                "found 0,3; allowed: a number above -1 and below 0.5. Write 0.3, with a point."},
        Mistake{"decimalCommaInBraces", &block, "nu: 0.3", "nu: 0,3", "3", "material.3",
                "found an unknown key; allowed: law, E, nu, volumetric. Write numbers with a point, "
                "such as 0.3."},
        Mistake{"unknownFunction", &block, "traction: [1, 0]", "traction: [cosine(1), 0]", "cosine",
                "loads[0].traction[0]",
                "the formula \"cosine(1)\" cannot be understood: \"cosine\" is no function; functions are "
                "abs, acos, acosh, asin"},
        Mistake{"nearlyAFunction", &block, "traction: [1, 0]", "traction: [sqr(2), 0]", "sqr",
                "loads[0].traction[0]",
                "the formula \"sqr(2)\" cannot be understood: \"sqr\" is no function (did you mean "
                "sqrt?); functions are abs"},
        Mistake{"overflowInAFormula", &block, "traction: [1, 0]", "traction: [2*1e400, 0]", "2*1e400",
                "loads[0].traction[0]",
                "the formula \"2*1e400\" has the number 1e400, which does not fit into double precision, "
                "between 1e-308 and 1e308 in size."},
        Mistake{"nearlyAConstant", &block, "traction: [1, 0]", "traction: [2*Pi, 0]", "2*Pi",
                "loads[0].traction[0]",
                "the formula \"2*Pi\" names Pi, which is unknown here (did you mean pi?); known are"},
        Mistake{"longFormula", &block, "traction: [1, 0]",
                "traction: [" + std::string(600'000, '1') + "+, 0]", "1111", "loads[0].traction[0]",
                "the formula \"" + std::string(60, '1') + "...\" cannot be understood: "},
        Mistake{"overflow", &block, "E: 1.0", "E: 1e400", "1e400", "material.E",
                "found 1e400; allowed: a number above 0 that is finite and fits into double precision, "
                "between 1e-308 and 1e308 in size."},
        Mistake{"truth", &block, "{face: bottom, fix: [x, y]}", "{face: bottom, fix: [x, y], symmetry: yes}",
                "yes", "supports[0].symmetry", "found yes; allowed: true or false."},
        Mistake{"choice", &block, "basis: nurbs", "basis: lagrang", "lagrang", "basis",
                "found lagrang; allowed: nurbs | lagrange. Did you mean \"lagrange\"?"},
        Mistake{
            "law", &block, "law: neo-hookean", "law: neohookean", "neohookean", "material.law",
            "found neohookean; allowed: neo-hookean | j2 | chaboche | mooney-rivlin | yeoh | ogden. Did you mean \"neo-hookean\"?"},
        Mistake{
            "method", &block, "method: augmented-lagrangian", "method: magic", "magic", "contact[0].method",
            "found magic; allowed: augmented-lagrangian | integral-augmented-lagrangian | penalty | pointwise-penalty."},
        Mistake{"listForNumber", &block, "E: 1.0", "E: [1.0]", "[1.0]", "material.E",
                "found a list of 1 entry; allowed: a number above 0."},
        Mistake{"numberForList", &block, "size: [3.0, 1.0]", "size: 3.0", "3.0", "geometry.size",
                "found 3.0; allowed: a list of numbers above 0, one per dimension."},
        Mistake{"mappingForList", &block, "supports:\n  - {face", "supports:\n  {face", "{", "supports",
                "found a mapping; allowed: a list of mappings."},
        Mistake{"textForMapping", &block, "output: {every: 0.1, subdivision: 4}", "output: often", "often",
                "output", "found often; allowed: a mapping."},
        Mistake{"toolName", &block, "name: plate", "name: \"a,b\"", "\"a,b", "tools[1].name",
                "found the text \"a,b\"; allowed: a name of letters, digits, - and _."}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Body, SceneMistake,
    testing::Values(
        Mistake{"incompressible", &block, "nu: 0.3", "nu: 0.5", "0.5", "material.nu",
                "found 0.5; allowed: a number above -1 and below 0.5."},
        Mistake{"negativeE", &block, "E: 1.0", "E: -1e-3", "-1e-3", "material.E",
                "found -1e-3; allowed: a number above 0."},
        Mistake{"degree", &block, "degree: 2", "degree: 11", "11", "degree",
                "found 11; allowed: a whole number from 1 to 10."},
        Mistake{"flat", &block, "size: [3.0, 1.0]", "size: [3.0, 0]", "0]", "geometry.size[1]",
                "found 0; allowed: a number above 0."},
        Mistake{"dimension", &block, "size: [3.0, 1.0]", "size: [3, 1, 1]", "[", "geometry.size",
                "found a list of 3; allowed: a list of 2, one entry per dimension of the body."},
        Mistake{"fewFunctions", &block, "[49, 25]", "[49, 2]", "2]", "geometry.functions[1]",
                "found 2; allowed: at least 3, the degree plus one."},
        Mistake{"noFunctions", &block, ", functions: [49, 25]", "", "{shape", "geometry",
                "found neither functions nor spans; allowed: exactly one of the two"},
        Mistake{"functionsAndSpans", &block, functions, functions + ", spans: [4, 4]", "[4, 4]",
                "geometry.spans", "found spans beside functions; allowed: one of the two."},
        Mistake{
            "lagrangeFunctions", &block,
            "basis: nurbs\ndegree: 2\ngeometry: {shape: rectangle, size: [3.0, 1.0], functions: [49, 25]",
            "basis: lagrange\ndegree: 3\ngeometry: {shape: rectangle, size: [3.0, 1.0], functions: [49, 24]",
            "24]", "geometry.functions[1]",
            "found 24; allowed for Lagrange elements of degree 3: a multiple of 3 plus one, such as 22 or "
            "25."},
        Mistake{
            "lagrangeMortar", &block,
            "basis: nurbs\ndegree: 2\ngeometry: {shape: rectangle, size: [3.0, 1.0], functions: [49, 25]",
            "basis: lagrange\ndegree: 8\ngeometry: {shape: rectangle, size: [3.0, 1.0], functions: [49, 25]",
            "8", "degree", "found 8; allowed for mortar contact with Lagrange elements: at most 7"},
        Mistake{"ring", &block, "shape: rectangle, size: [3.0, 1.0]",
                "shape: annulus, inner_radius: 2, outer_radius: 1", "1", "geometry.outer_radius",
                "found 1; allowed: a number above the inner radius 2."},
        Mistake{"halfRing", &block, "shape: rectangle, size: [3.0, 1.0]",
                "shape: annulus, inner_radius: 1, outer_radius: 2, opening_angle: 180", "180",
                "geometry.opening_angle", "found 180; allowed: a number above 0 and below 180."},
        Mistake{"linearArc", &block, "degree: 2\ngeometry: {shape: rectangle, size: [3.0, 1.0]",
                "degree: 1\ngeometry: {shape: annulus, inner_radius: 1, outer_radius: 2", "1", "degree",
                "found 1; allowed for an annulus in NURBS: at least 2"}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    RoundBody, SceneMistake,
    testing::Values(
        Mistake{"tube", &solid, kBox, "shape: tube, inner_radius: 2, outer_radius: 1, length: 3", "1, length",
                "geometry.outer_radius", "found 1; allowed: a number above the inner radius 2."},
        Mistake{"axis", &solid, kBox, "shape: cylinder, radius: 1, length: 3, axis: [0, 0, 0]", "[0, 0, 0]",
                "geometry.axis", "found a vector of length 0; allowed: a direction, such as [0, 0, 1]."},
        Mistake{"opening", &solid, kBox, "shape: cylinder, radius: 1, length: 3, opening_angle: 180", "180",
                "geometry.opening_angle",
                "found 180; allowed: a number above 0 and below 180, or 360 for the whole cylinder."},
        Mistake{"discOpening", &block, "shape: rectangle, size: [3.0, 1.0]",
                "shape: disc, radius: 1, opening_angle: 200", "200", "geometry.opening_angle",
                "found 200; allowed: a number above 0 and below 180, or 360 for the whole disc."},
        Mistake{"ellipse", &block, "shape: rectangle, size: [3.0, 1.0]", "shape: ellipse, size: [3, -1]",
                "-1", "geometry.size[1]", "found -1; allowed: a number above 0"},
        Mistake{"linearDisc", &block, "degree: 2\ngeometry: {shape: rectangle, size: [3.0, 1.0]",
                "degree: 1\ngeometry: {shape: disc, radius: 1", "1", "degree",
                "found 1; allowed for a disc in NURBS: at least 2"},
        Mistake{"pole", &solid, kBox, "shape: ball-octant, radius: 1, pole: [0, 0]", "[0, 0]",
                "geometry.pole",
                "found a list of 2; allowed: a list of 3, one entry per dimension of the body."},
        Mistake{"linearBall", &solid, "degree: 2\ngeometry: {shape: box, size: [1, 1, 1]",
                "degree: 1\ngeometry: {shape: ball-octant, radius: 1", "1", "degree",
                "found 1; allowed for a ball in NURBS: at least 2"}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    ControlNet, SceneMistake,
    testing::Values(
        Mistake{"weight", &net, "[1, 1, 0.7", "[1, -1, 0.7", "-1", "geometry.weights[1]",
                "found -1; allowed: a number above 0."},
        Mistake{"weightCount", &net, "[1, 1, 0.7", "[1, 0.7", "[", "geometry.weights",
                "found 5 weights for 6 points; allowed: one per control point."},
        Mistake{"decreasingKnots", &net, "[0, 0, 0, 1, 1, 1]", "[0, 0, 0, 1, 0.5, 1]", "[",
                "geometry.knots[1]",
                "knot vector: knot 5 = 0.5 is smaller than the one before it (1); knots must not decrease."},
        Mistake{"closedKnots", &net, "[0, 0, 0, 1, 1, 1]", "[0, 0, 0.5, 1, 1, 1]", "[", "geometry.knots[1]",
                "knot vector: the end knots stand 2 and 3 times; an open knot vector of degree 2 repeats "
                "each of them 3 times."},
        Mistake{"knotVectors", &net, "[[0, 0, 1, 1], ", "[[0, 0, 1, 1], [0, 0, 1, 1], ", "[[",
                "geometry.knots", "found 3 knot vectors for 2 degrees; allowed: one per direction."},
        Mistake{"points", &net, "[0, 1], [0, 2]]", "[0, 1]]", "[[1, 0]", "geometry.points",
                "found 5 points; allowed: 6, as many as the knots make basis functions."},
        Mistake{"coordinates", &net, "[0, 1], [0, 2]]", "[0, 1], [0, 2, 0]]", "[0, 2, 0]",
                "geometry.points[5]", "found 3 coordinates; allowed: 2, one per direction of the body."},
        Mistake{"functions", &net, "degrees: [1, 2]", "degrees: [1, 2]\n  functions: [2, 3]", "[2, 3]",
                "geometry.functions",
                "found functions, but a control net brings its own knots; allowed: refine."},
        Mistake{"noDegrees", &net, "  degrees: [1, 2]\n", "", "shape", "geometry.degrees",
                "missing; required: degrees, knots and points, or a file that holds them."},
        Mistake{"fileBesideKeys", &net, "degrees: [1, 2]", "file: net.yaml\n  degrees: [1, 2]", "degrees",
                "geometry.degrees",
                "found degrees beside file; allowed: all of the control net either here or in the file."},
        Mistake{
            "grading", &stripes, "refine: [2, 2]", "refine: [2, 2]\n  grading: [s^2, s]", "s^2",
            "geometry.grading[0]",
            "found \"s^2\", but the control net has 2 knot spans in this direction, not one to be graded; "
            "allowed: s,"},
        Mistake{"directions", &net, "degrees: [1, 2]", "degrees: [1, 2, 2, 2]", "[", "geometry.degrees",
                "found a list of 4 entries; allowed: a list of 2 to 3 whole numbers from 1 to 10."}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Mesh, SceneMistake,
    testing::Values(
        Mistake{"refine", &block, functions, "spans: [4, 4], refine: [2, 2]", "[2, 2]", "geometry.refine",
                "found refine, which divides the knot spans of a control net; allowed: spans."},
        Mistake{"crease", &block, functions, "spans: [4, 4], creases: [[0.5], [0, 1.5]]", "1.5",
                "geometry.creases[1][1]", "found 1.5; allowed: a number from 0 to 1."},
        Mistake{"reliefFace", &block, functions, "spans: [4, 4], relief: [{face: up, height: 1}]", "up",
                "geometry.relief[0].face", "'up' is not a face"},
        Mistake{"reliefInTime", &block, functions, "spans: [4, 4], relief: [{face: top, height: 0.1*t}]",
                "0.1*t", "geometry.relief[0].height",
                "found \"0.1*t\", which depends on t; allowed: a formula in X, Y and Z"},
        Mistake{"reliefOfNothing", &block, functions, "spans: [4, 4], relief: [{face: top}]", "{face: top}",
                "geometry.relief[0].height", "missing; required: height, a formula, or file"},
        Mistake{"reliefAlongTime", &block, functions,
                "spans: [4, 4], relief: [{face: top, places: [0, 9], heights: [0, 0], along: X - t}]",
                "X - t", "geometry.relief[0].along", "found \"X - t\", which depends on t"},
        Mistake{"creasesPerDirection", &block, functions, "spans: [4, 4], creases: [[0.5]]", "[[",
                "geometry.creases", "found a list of 1; allowed: a list of 2, one entry per dimension"},
        Mistake{"creasesBesideFunctions", &block, functions, functions + ", creases: [[0.5], []]", "[49, 25]",
                "geometry.functions", "found functions beside creases, which add functions; allowed: spans."},
        Mistake{"gradingAtTheStart", &block, functions, "spans: [4, 4], grading: [s, s + 1]", "s + 1",
                "geometry.grading[1]",
                "found \"s + 1\", which takes s = 0 to 1; allowed: a formula in s that grows from 0 at s = 0 "
                "to 1 "
                "at s = 1."},
        Mistake{"gradingAtTheEnd", &block, functions, "spans: [4, 4], grading: [2 * s, s]", "2 * s",
                "geometry.grading[0]",
                "found \"2 * s\", which takes s = 1 to 2; allowed: a formula in s that"},
        Mistake{"gradingThatFalls", &block, functions, "spans: [4, 4], grading: [5 * s - 4 * s^2, s]",
                "5 * s", "geometry.grading[0]",
                "found \"5 * s - 4 * s^2\", which takes s = 0.75 to 1.5 after 1.5; allowed:"},
        Mistake{"gradingOfSomethingElse", &block, functions, "spans: [4, 4], grading: [X, s]", "X",
                "geometry.grading[0]",
                "the formula \"X\" names X, which is unknown here; known are s; functions are abs, "},
        Mistake{"gradingThatIsNoNumber", &block, functions, "spans: [4, 4], grading: [ln(s), s]", "ln",
                "geometry.grading[0]", "the formula \"ln(s)\" has no finite value at s = 0."},
        Mistake{"manyFunctions", &block, functions, "spans: [9000, 9000]", "[9000", "geometry.spans",
                "found 8.1e+07 basis functions in all; allowed: at most 500000."}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Patches, SceneMistake,
    testing::Values(
        Mistake{"none", &pair, pairOfPatches, "patches: []\n", "[]", "geometry.patches",
                "found a list of 0 entries; allowed: a list of 1 or more mappings."},
        Mistake{"noName", &pair, "{name: b, ", "{", "{", "geometry.patches[1].name",
                "missing; required: a name of letters, digits, - and _."},
        Mistake{"sameName", &pair, "b, shape", "a, shape", "a, shape", "geometry.patches[1].name",
                "found a, the name of another patch; allowed: a name of its own for each patch."},
        Mistake{"shape", &pair, "shape: rectangle, origin", "shape: patches, origin", "patches",
                "geometry.patches[1].shape",
                "found patches; allowed: rectangle | annulus | disc | ellipse | box | tube | cylinder | "
                "ball-octant | extrusion | revolution | sweep | coons | control-net."},
        Mistake{"dimension", &pair, "rectangle, origin: [1, 0], size: [1, 1], spans: [2, 2]",
                "box, size: [1, 1, 1], spans: [2, 2, 2]", "{name: b", "geometry.patches[1]",
                "found a shape of 3 dimensions; allowed: 2 dimensions, as the first patch has."},
        Mistake{"noMesh", &pair, ", spans: [2, 2]}\nmaterial", "}\nmaterial", "{name: b",
                "geometry.patches[1]", "found neither functions nor spans; allowed: exactly one of the two"},
        Mistake{"commonMesh", &pair, "shape: patches", "shape: patches\n  spans: [3, 3]", "[3, 3]",
                "geometry.spans", "found spans beside patches; allowed: in each of the patches."},
        Mistake{"entry", &pair, "origin: [1, 0]", "origin: [1, 0, 0]", "[1, 0, 0]",
                "geometry.patches[1].origin",
                "found a list of 3; allowed: a list of 2, one entry per dimension of the body."},
        Mistake{
            "key", &pair, "origin: [1, 0]", "orgin: [1, 0]", "orgin", "geometry.patches[1].orgin",
            "found an unknown key; allowed: name, shape, origin, size, functions, spans, refine, grading, "
            "creases, resolution, relief. Did you mean \"origin\"?"}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Hardening, SceneMistake,
    testing::Values(
        Mistake{"yieldStress", &net, hardening, "hardening: {law: linear, sigma0: 0, modulus: 1}", "0, mod",
                "material.hardening.sigma0", "found 0; allowed: a number above 0."},
        Mistake{"missing", &net, ", " + hardening, "", "{law: j2", "material.hardening",
                "missing; required: a mapping."},
        Mistake{"tableStart", &net, "ep: [0, 0.1]", "ep: [0.01, 0.1]", "0.01", "material.hardening.ep[0]",
                "found 0.01; allowed: 0, the table begins without plastic strain."},
        Mistake{"tableOrder", &net, "ep: [0, 0.1]", "ep: [0, 0]", "0]", "material.hardening.ep[1]",
                "found 0 after 0; allowed: numbers that increase"},
        Mistake{"tableLength", &net, "stress: [80, 120]", "stress: [80]", "[80]", "material.hardening.stress",
                "found 1 stresses for 2 plastic strains; allowed: one for each."},
        Mistake{
            "formula", &net, hardening, "hardening: {law: formula, formula: 80 + q}", "80 + q",
            "material.hardening.formula",
            "the formula \"80 + q\" names q, which is unknown here; known are ep; functions are abs, acos"},
        Mistake{"formulaSign", &net, hardening, "hardening: {law: formula, formula: ep - 1}", "ep - 1",
                "material.hardening.formula",
                "found a yield stress of -1 at ep = 0; allowed: a formula that is positive there."}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Bodies, SceneMistake,
    testing::Values(
        Mistake{"unknown", &twoBodies, "body: soft, face: bottom", "body: sotf, face: bottom", "sotf",
                "supports[0].body", "found sotf; allowed: soft | firm. Did you mean \"soft\"?"},
        Mistake{"missing", &twoBodies, "body: soft, face: bottom", "face: bottom", "{face: bottom",
                "supports[0].body", "missing; allowed: soft | firm."},
        Mistake{"missingInContact", &twoBodies, "tool: plate, body: soft,", "tool: plate,",
                "{tool: plate, face", "contact[0].body", "missing; allowed: soft | firm."},
        Mistake{"missingInMeasure", &twoBodies, "kind: percentile, body: soft", "kind: percentile",
                "{name: tall", "measures[2].body", "missing; allowed: soft | firm."},
        Mistake{"ofASceneOfOne", &block, "{face: bottom, fix", "{body: block, face: bottom, fix", "block",
                "supports[0].body",
                "found block, but the one body of the scene has no name; allowed: leave the key out."},
        Mistake{"nameTwice", &twoBodies, "supports:", thirdBody("soft"), "soft, geometry", "bodies[2].name",
                "found soft, the name of another body or a tool; allowed: a name of its own."},
        Mistake{"nameOfATool", &twoBodies, "supports:", thirdBody("plate"), "plate, geometry",
                "bodies[2].name",
                "found plate, the name of another body or a tool; allowed: a name of its own."},
        Mistake{"nameOfAMeasure", &twoBodies, "name: corner", "name: firm", "firm, kind", "measures[0].name",
                "found firm, the name of another measure, body or tool; allowed: a name of its own."},
        Mistake{"geometryBeside", &twoBodies, "formulation: fbar\n",
                "geometry: {shape: rectangle, size: [1, 1], spans: [2, 2]}\n",
                "{shape: rectangle, size: [1, 1], spans: [2", "geometry",
                "found geometry beside bodies; allowed: in each of the bodies."},
        Mistake{"noGeometry", &twoBodies, "    geometry: {shape: rectangle, size: [1, 1], spans: [4, 3]}\n",
                "", "name: soft", "bodies[0].geometry", "missing; required: a mapping."},
        Mistake{"fieldOfTheOther", &twoBodies, "fields: [displacement, von_mises]",
                "fields: [plastic_strain]", "plastic_strain", "measures[0].fields[0]",
                "found plastic_strain, but "},
        Mistake{"otherDimension", &twoBodies,
                "shape: rectangle, origin: [1.5, 0], size: [0.5, 1], spans: [2, 3]",
                "shape: box, size: [1, 1, 1], spans: [2, 2, 2]", "{shape: box", "bodies[1].geometry",
                "found a shape of 3 dimensions; allowed: 2 dimensions, as the first body has."},
        Mistake{"fewPoints", &twoBodies, "quadrature_points: 5", "quadrature_points: 3", "3\n    geometry",
                "bodies[1].quadrature_points", "found 3; allowed: at least 4, the degree plus one."},
        Mistake{"fewPointsOfSplines", &twoBodies, "    degree: 2\n",
                "    degree: 2\n    quadrature_points: 1\n", "1\n    geometry", "bodies[0].quadrature_points",
                "found 1; allowed: at least 2, the degree."},
        Mistake{"rezoned", &twoBodies, "steps:", "rezoning: {}\nsteps:", "{}", "rezoning.body",
                "missing; allowed: soft | firm."}),
    nameOf);

const std::string kPlateOnFirm = "tool: plate, body: firm, face: top";
const char* const kWhereSegmentsAre =
    "found true; allowed: beside against, in scenes of two dimensions, with other methods than "
    "pointwise-penalty.";
std::string firmAgainst(const std::string& faces) {
  return "body: firm, face: left, against: " + faces;
}

INSTANTIATE_TEST_SUITE_P(
    Pairs, SceneMistake,
    testing::Values(
        Mistake{"faceOfAList", &twoBodies, kPlateOnFirm,
                firmAgainst("[{body: soft, face: right}, {body: soft, face: rihgt}]"), "rihgt",
                "contact[1].against[1].face",
                "found rihgt; allowed: left | right | bottom | top | back | front. Did you mean \"right\"?"},
        Mistake{"twiceInAList", &twoBodies, kPlateOnFirm,
                firmAgainst("[{body: soft, face: right}, {body: soft, face: right}]"),
                "{body: soft, face: right}]", "contact[1].against[1]",
                "found face right a second time; allowed: each face once."},
        Mistake{"itselfInAList", &twoBodies, kPlateOnFirm,
                firmAgainst("[{body: soft, face: right}, {body: firm, face: left}]"),
                "{body: firm, face: left}]", "contact[1].against[1]",
                "found face left itself; allowed: another face, or the key self_contact."},
        Mistake{"emptyList", &twoBodies, kPlateOnFirm, firmAgainst("[]"), "[]", "contact[1].against",
                "found a list of 0 entries; allowed: a mapping, or a list of mappings."},
        Mistake{"segmentsOfATool", &twoBodies, kPlateOnFirm, kPlateOnFirm + ", segments: true", "true",
                "contact[1].segments", kWhereSegmentsAre},
        Mistake{"segmentsOfPointsThatRemember", &twoBodies, kPlateOnFirm,
                firmAgainst("{body: soft, face: right}, method: pointwise-penalty, segments: true"), "true",
                "contact[1].segments", kWhereSegmentsAre},
        Mistake{"segmentsInSpace", &solid,
                "steps:", "contact: [{face: top, against: {face: bottom}, segments: true}]\nsteps:", "true",
                "contact[0].segments", kWhereSegmentsAre},
        Mistake{
            "bothSlave", &twoBodies, kPlateOnFirm,
            firmAgainst("{body: soft, face: right}") +
                "}\n  - {body: soft, face: right, against: [{body: soft, face: left}, {body: firm, face: left}]",
            "{body: soft, face: right, against", "contact[2]",
            "found the faces right and left of another pair with their parts changed, so that both would "
            "carry multipliers; allowed: one pair, with the finer face named first."}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Boundary, SceneMistake,
    testing::Values(
        Mistake{"face", &block, "face: bottom", "face: botom", "botom", "supports[0].face",
                "found botom; allowed: left | right | bottom | top | back | front. Did you mean \"bottom\"?"},
        Mistake{
            "face3d", &block, "face: top", "face: front", "front", "contact[0].face",
            "found front, a face of three-dimensional bodies; allowed here: left | right | bottom | top."},
        Mistake{"component3d", &block, "fix: [x, y]", "fix: [x, z]", "z", "supports[0].fix[1]",
                "found z, a component of three-dimensional scenes; allowed here: x and y."},
        Mistake{"componentTwice", &block, "fix: [x, y]", "fix: [x, x]", "x]", "supports[0].fix[1]",
                "found x a second time; allowed: each component once."},
        Mistake{"supportNameTwice", &block, "{face: bottom, fix: [x, y]}",
                "{face: bottom, fix: [x, y], name: floor}\n  - {face: top, fix: [x], name: floor}",
                "{face: top", "supports[1]",
                "found the name floor, which another support, a body, a tool or a measure has"},
        Mistake{"noSupport", &block, "{face: bottom, fix: [x, y]}", "{face: bottom}", "{", "supports[0]",
                "found none of fix, move, prescribe and symmetry; allowed: exactly one of"},
        Mistake{"severalSupports", &block, "{face: bottom, fix: [x, y]}",
                "{face: bottom, fix: [x, y], symmetry: true}", "{", "supports[0]",
                "found fix and symmetry; allowed: exactly one of"},
        Mistake{"emptyMove", &block, "fix: [x, y]", "move: {times: [0, 1]}", "{times", "supports[0].move",
                "found no component; allowed: one or more of x, y, z."},
        Mistake{"timesNotIncreasing", &block, "times: [0, 1, 2]", "times: [0, 2, 1]", "1]",
                "tools[0].motion.times[2]", "found 1 after 2; allowed: numbers that increase"},
        Mistake{"motionLength", &block, "x: [0, 0, 2]", "x: [0, 2]", "[", "tools[0].motion.x",
                "found 2 values for 3 times; allowed: one value for each of the times."},
        Mistake{"motionInSpace", &block, "motion: {times: [0, 1, 2], x: [0, 0, 2]", "prescribe: {x: 2*X",
                "2*X", "tools[0].prescribe.x",
                "found \"2*X\", which depends on X; allowed: t and the definitions."},
        Mistake{"motion3d", &block, "x: [0, 0, 2]", "z: [0, 0, 2]", "[", "tools[0].motion.z",
                "found a component of three-dimensional scenes; allowed here: x and y."},
        Mistake{"scheduleLength", &block, "values: [0, 1]", "values: [0, 1, 2]", "[",
                "loads[0].schedule.values",
                "found 3 values for 2 times; allowed: one value for each of the times."},
        Mistake{"traction", &block, "traction: [1, 0]", "traction: [1]", "[", "loads[0].traction",
                "found a list of 1; allowed: a list of 2, one entry per dimension of the body."},
        Mistake{"radius", &block, "radius: 0.5", "radius: 0", "0", "tools[0].radius",
                "found 0; allowed: a number above 0."},
        Mistake{"center", &block, "center: [0.5, 1.5]", "center: [0.5, 1.5, 0]", "[", "tools[0].center",
                "found a list of 3; allowed: a list of 2"},
        Mistake{"normal", &block, "normal: [0, -1]", "normal: [0, 0]", "[", "tools[1].normal",
                "found a vector without length"},
        Mistake{"axis", &block, "radius: 0.5", "radius: 0.5, axis: [1, 0, 0]", "[", "tools[0].axis",
                "found [1, 0, 0]; allowed in two dimensions: [0, 0, 1]."},
        Mistake{"sphere", &block, "shape: cylinder", "shape: sphere", "sphere", "tools[0].shape",
                "found sphere, which needs a three-dimensional body; allowed here: plane | cylinder | edge | "
                "box | "
                "nurbs | polyline | union."},
        Mistake{"sameToolName", &block, "name: plate", "name: cylinder", "cylinder", "tools[1].name",
                "found cylinder, the name of another tool; allowed: a name of its own for each tool."},
        Mistake{"unknownTool", &block, "tool: cylinder", "tool: cylindre", "cylindre", "contact[0].tool",
                "found cylindre, but no tool has this name; allowed: cylinder | plate. Did you mean "
                "\"cylinder\"?"},
        Mistake{"samePair", &block, "steps:", "  - {tool: cylinder, face: top}\nsteps:", "{", "contact[1]",
                "found the pair of tool cylinder and face top a second time; allowed: each pair once."},
        Mistake{"gapLimitWithoutAverages", &block, "method: augmented-lagrangian}",
                "method: pointwise-penalty, gap_limit: 0.02}", "0.02", "contact[0].gap_limit",
                "found with method pointwise-penalty, which averages no gaps; allowed: with "
                "augmented-lagrangian and penalty."},
        Mistake{"gapLimitOfAFreeTool", &block,
                "motion: {times: [0, 1, 2], x: [0, 0, 2]}}\n"
                "  - {name: plate, shape: plane, origin: [0, 2], normal: [0, -1]}\n"
                "contact:\n  - {tool: cylinder, face: top, method: augmented-lagrangian}",
                "carry: {y: -1}}\n"
                "  - {name: plate, shape: plane, origin: [0, 2], normal: [0, -1]}\n"
                "contact:\n  - {tool: cylinder, face: top, method: augmented-lagrangian, gap_limit: 0.02}",
                "0.02", "contact[0].gap_limit",
                "found for a tool that carries a load; allowed: for tools whose motion is given."},
        Mistake{"gapLimitOfNothing", &block, "method: augmented-lagrangian}", "gap_limit: 0}", "0}",
                "contact[0].gap_limit", "found 0; allowed: a number above 0 and at most 1."},
        Mistake{"gapLimitOfTheIntegralMethod", &block, "method: augmented-lagrangian}",
                "method: integral-augmented-lagrangian, gap_limit: 0.02}", "0.02", "contact[0].gap_limit",
                "found with method integral-augmented-lagrangian, which averages no gaps; allowed: with "
                "augmented-lagrangian and penalty."},
        Mistake{
            "frictionBelowZero", &block, "method: augmented-lagrangian}", "friction: -0.2}", "-0.2",
            "contact[0].friction",
            "found \"-0.2\"; allowed: a number at least 0, or a formula in p, slip, t, X, Y, Z and the definitions."},
        Mistake{"frictionAndRough", &block, "method: augmented-lagrangian}",
                "method: integral-augmented-lagrangian, friction: 0.2, rough: true}", "true}",
                "contact[0].rough", "found beside friction; allowed: one of the two."},
        Mistake{"shearLimitWithoutFriction", &block, "method: augmented-lagrangian}",
                "method: integral-augmented-lagrangian, shear_limit: 3}", "3}", "contact[0].shear_limit",
                "found without friction; allowed: beside friction."},
        Mistake{"sameSelfContact", &block,
                "steps:", "self_contact: [{face: top}, {face: top, reach: 1}]\nsteps:", "{face: top, reach",
                "self_contact[1]", "found face top a second time; allowed: each face once."},
        Mistake{"reachOfNothing", &block, "steps:", "self_contact: [{face: top, reach: 0}]\nsteps:", "0}",
                "self_contact[0].reach", "found 0; allowed: a number above 0."},
        Mistake{"selfGapLimitOfNothing", &block,
                "steps:", "self_contact: [{face: top, gap_limit: 0}]\nsteps:", "0}",
                "self_contact[0].gap_limit", "found 0; allowed: a number above 0 and at most 1."},
        Mistake{"selfGapLimitOfMoreThanASpan", &block,
                "steps:", "self_contact: [{face: top, gap_limit: 2}]\nsteps:", "2}",
                "self_contact[0].gap_limit", "found 2; allowed: a number above 0 and at most 1."},
        Mistake{"selfContactOfAFaceAndOthers", &block,
                "steps:", "self_contact: [{face: top, faces: [left, right]}]\nsteps:", "top, faces",
                "self_contact[0].face", "found beside faces; allowed: one of the two."},
        Mistake{"selfContactOfAFaceOfSolids", &block,
                "steps:", "self_contact: [{faces: [top, back]}]\nsteps:", "back]", "self_contact[0].faces[1]",
                "found back, a face of three-dimensional bodies; allowed here: left | right | bottom | top."},
        Mistake{"selfContactOfFacesAgain", &block,
                "steps:", "self_contact: [{face: top}, {faces: [left, top]}]\nsteps:", "{faces",
                "self_contact[1]", "found face top a second time; allowed: each face once."},
        Mistake{"selfContactOfNoFace", &block, "steps:", "self_contact: [{reach: 1}]\nsteps:", "{reach",
                "self_contact[0].face",
                "missing; allowed: left | right | bottom | top, in three dimensions also back | front."}),
    nameOf);

INSTANTIATE_TEST_SUITE_P(
    Run, SceneMistake,
    testing::Values(Mistake{"steps", &block, "until: 2", "until: 1", "1", "steps[1].until",
                            "found 1 after 1; allowed: a time after the end of the phase before."},
                    Mistake{"noSteps", &block,
                            "steps:\n  - {until: 1, count: 20}\n  - {until: 2, count: 200}\n", "steps: []\n",
                            "[]", "steps",
                            "found a list of 0 entries; allowed: a list of 1 or more mappings."},
                    Mistake{"lateOutput", &block, "every: 0.1", "times: [1, 3]", "3", "output.times[1]",
                            "found 3; allowed: a time up to the end of the run at 2."},
                    Mistake{"manyFrames", &block, "every: 0.1", "every: 1e-9", "1e-9", "output.every",
                            "found 1e-09, which makes more than 100000 frames; allowed: at least"}),
    nameOf);

}  // namespace
}  // namespace burnish
