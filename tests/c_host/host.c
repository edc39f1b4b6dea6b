/* A host in plain C11: the map through its C interface, of which one C++ object holds the definitions. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <asperity/friction_map.hpp>

static int failed = 0;

static void check(int fine, const char* what) {
  printf("%s: %s\n", fine ? "ok" : "FAILED", what);
  if (!fine) failed = 1;
}

int main(int count, char** arguments) {
  if (count != 2) return 2;
  char why[200] = "untouched";
  asperity_map* map = asperity_map_load(arguments[1], why, sizeof why);
  if (map == NULL) {
    printf("FAILED: %s\n", why);
    return 1;
  }
  check(strcmp(why, "untouched") == 0, "a map is loaded");
  check(asperity_map_max_error(map) > 0 && asperity_map_max_error(map) < 0.01, "its certified error");

  const double p = 2e5, v = 0.3;
  double out[6];
  check(asperity_map_at(map, p, v, 1, 0, out) == 0, "a point inside of the box");
  check(asperity_map_mu(map, p, v, 1, 0) == out[0] && out[0] > 0 && out[0] == out[1] + out[2], "mu and its parts");
  const double h = 1e-4;
  const double above = asperity_map_mu(map, p * exp(h), v, 1, 0), below = asperity_map_mu(map, p * exp(-h), v, 1, 0);
  /* second order in h, and rounding over it: both below 1e-7 */
  check(fabs((above - below) / (2 * h) - out[4]) < 1e-6, "d mu / d ln p");
  check(asperity_map_mu(map, p, -v, 1, 0) == out[0], "even in the velocity");
  double toward[7];
  check(asperity_map_toward(map, p, v, 1, 0.5, 0, toward) == 0 && toward[0] == out[0] && toward[6] == 0,
        "the same in every direction where the map knows none");

  const double pressures[] = {p, 1, p}, velocities[] = {v, v, -v};
  double many[3];
  asperity_map_mu_at_points(map, 3, pressures, velocities, 1, 0, many);
  check(many[0] == out[0] && isnan(many[1]) && many[2] == out[0], "mu at several points");

  /* the map has heat, of one temperature of the background */
  const double hot = out[0], after = asperity_map_hot_mu(map, p, v, 293.15, 1e-4, 0);
  const double cold = asperity_map_hot_mu(map, p, v, 293.15, 0, 0);
  check(asperity_map_hot_mu(map, p, v, 293.15, 1e300, 0) == hot, "slid long ago");
  check(asperity_map_hot_mu(map, p, v, 0, 1e300, 0) == hot, "its only temperature need not be given");
  check(cold > 0 && cold != hot && (after - cold) * (hot - after) > 0, "after a distance between cold and hot");
  check(asperity_map_hot_at(map, p, v, 293.15, 1e-4, 0, out) == 0 && out[0] == after, "and its parts");
  check(asperity_map_hot_at(map, p, v, 400, 1e-4, 0, out) == 4 && isnan(out[0]), "the temperature outside");
  check(asperity_map_hot_at(map, p, v, 293.15, -1, 0, out) == 3 && isnan(out[0]), "a negative distance");
  check(asperity_map_at(map, p, v, 2, 1, out) == 5 && isnan(out[0]), "no a_T on a map with heat");
  asperity_map_at(map, p, v, 1, 0, out);

  check(isnan(asperity_map_mu(map, 1, v, 1, 0)), "NaN outside of the box");
  check(asperity_map_at(map, 1, v, 1, 1, out) == 1 && out[0] > 0 && out[4] == 0, "or the value at its side");
  check(asperity_map_at(map, p, 1e9, 1, 0, out) == 2 && isnan(out[0]), "the velocity outside of the box");
  check(asperity_map_at(map, NAN, v, 1, 1, out) == 3 && isnan(out[0]), "NaN in, NaN out");
  asperity_map_free(map);
  asperity_map_free(NULL);

  check(asperity_map_load("no such file", why, sizeof why) == NULL && strstr(why, "no such file: cannot be read: "),
        why);
  check(asperity_map_load(__FILE__, why, sizeof why) == NULL && strstr(why, "is no friction map"), why);
  char brief[8];
  check(asperity_map_load("no such file", brief, sizeof brief) == NULL && strcmp(brief, "no such") == 0,
        "a message cut to the room it has");
  check(asperity_map_load("no such file", NULL, 0) == NULL, "or left out");
  return failed;
}
