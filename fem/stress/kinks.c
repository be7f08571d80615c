/* Weighted sums of the fields of kinks: see kinks.py for the nomenclature and the equations. */
#include <complex.h>
#include <math.h>

#define PI 3.14159265358979323846
typedef double complex place_t;

/* sx, sz, txz [Pa] */
static void stress_of(place_t w, place_t log_w, place_t f, place_t t, double *found) {
    place_t steep = w * log_w;
    place_t turned = (cimag(w) * (log_w + 1.0) * f + cimag(f) * steep) * conj(t) * conj(t) / PI;
    double mean = -cimag(f * steep) / PI;
    found[0] = mean - creal(turned);
    found[1] = mean + creal(turned);
    found[2] = cimag(turned);
}

/* G u_x, G u_z [N/m] */
static void displacement_of(
    place_t w, place_t log_w, place_t f, place_t t, double nu, double *found) {
    place_t integral = 0.5 * w * w * (log_w - 0.5);
    place_t both = 0.25 / PI * I * t * ((3.0 - 4.0 * nu) * integral + conj(integral));
    place_t moved = f * both - conj(f) * (0.5 / PI * t * cimag(w) * conj(w * log_w));
    found[0] = creal(moved);
    found[1] = cimag(moved);
}

/* For rows r of q points each: the sum over the kinks near `patch`[r] of their field at
   `place`[point], times their weights, into found (rows * q, loads, columns), zero before. The
   field is computed once for each pair of a place and a kink. columns: 3 of stresses, 2 of
   displacements. begin (places + 1), order (rows * q), table (kinks, loads, columns) are room;
   begin is zero before. */
void add_up(long rows, long q, long places, long loads, long columns, double nu, const long *patch,
            const long *point, const double *place, const long *first, const long *start,
            const double *weight, const double *kink, const double *tangent, const double *jump,
            long *begin, long *order, double *table, double *found) {
    long size = loads * columns;
    for (long i = 0; i < rows * q; i++) begin[point[i] + 1]++;
    for (long n = 0; n < places; n++) begin[n + 1] += begin[n];
    for (long i = rows * q - 1; i >= 0; i--) order[--begin[point[i] + 1]] = i;
    /* now begin[n + 1] is where the rows of place n begin, and the next one's where they end */
    for (long n = 0; n < places; n++) {
        long from = begin[n + 1], to = n + 1 < places ? begin[n + 2] : rows * q;
        long low = -1, high = -1;
        for (long i = from; i < to; i++) {
            long p = patch[order[i] / q], last = first[p] + start[p + 1] - start[p];
            if (last == first[p]) continue;
            if (low < 0 || first[p] < low) low = first[p];
            if (last > high) high = last;
        }
        for (long k = low; k < high; k++) {
            place_t t = tangent[2 * k] + I * tangent[2 * k + 1];
            place_t w = place[2 * n] - kink[2 * k] + I * (place[2 * n + 1] - kink[2 * k + 1]);
            w *= conj(t);
            double square = creal(w) * creal(w) + cimag(w) * cimag(w);
            place_t log_w = 0.0;
            if (square > 0.0)
                log_w = 0.5 * log(square) + I * (0.5 * PI - atan2(creal(w), cimag(w)));
            for (long c = 0; c < loads; c++) {
                const double *f = jump + 2 * (k * loads + c);
                double *own = table + (k - low) * size + c * columns;
                if (columns == 3)
                    stress_of(w, log_w, f[0] + I * f[1], t, own);
                else
                    displacement_of(w, log_w, f[0] + I * f[1], t, nu, own);
            }
        }
        for (long i = from; i < to; i++) {
            long p = patch[order[i] / q], count = start[p + 1] - start[p];
            double *restrict sum = found + order[i] * size;
            const double *restrict own = table + (first[p] - low) * size, *restrict by = weight + start[p];
            for (long k = 0; k < count; k++, own += size)
                for (long j = 0; j < size; j++) sum[j] += by[k] * own[j];
        }
    }
}
