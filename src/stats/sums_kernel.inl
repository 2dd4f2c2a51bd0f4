/// The loops of SumsKernel, in an unnamed namespace of the file that includes this.
/// Vectors are the compiler's own: as many registers as the instruction set needs for
/// eight parts. Four sums at once use each value that is loaded twice.

namespace {

using Register = double __attribute__((vector_size(width * sizeof(double))));
constexpr long n_registers = parts / width;

/// A sum in its parts.
struct Parts {
    Register registers[n_registers] = {};

    double& operator[](long part) { return reinterpret_cast<double*>(registers)[part]; }
};

/// A copy, since readings need not stand where a register may be read in place.
inline Register register_at(const double* values, long i) {
    Register values_of_i;
    __builtin_memcpy(&values_of_i, values + i * width, sizeof values_of_i);
    return values_of_i;
}

/// Holds a value in its register; the compiler would load it again for each use.
inline void hold(Register& value) {
#if defined(__x86_64__)
    asm("" : "+x"(value));
#else
    static_cast<void>(value);
#endif
}

inline void add_up(Parts& p, double& sum) {
    sum += ((p[0] + p[4]) + (p[2] + p[6])) + ((p[1] + p[5]) + (p[3] + p[7]));
}

/// What is left of the readings goes to the first parts.
inline void add_rest(const double* a, const double* b, long from, long n, Parts& p) {
    for (long k = from; k < n; ++k) p[k - from] += a[k] * b[k];
}

void add_products(const double* const* rows, long n_rows, const double* v, long n,
                  double* sums) {
    const long whole = n - n % parts;
    for (long r = 0; r < n_rows; r += 4) {
        // The last rows are taken twice, or more often, where fewer than four are left.
        const double* of[4];
        for (long i = 0; i < 4; ++i) of[i] = rows[r + i < n_rows ? r + i : n_rows - 1];
        Parts a{}, b{}, c{}, d{};
        for (long k = 0; k < whole; k += parts) {
            for (long i = 0; i < n_registers; ++i) {
                const Register w = register_at(v + k, i);
                a.registers[i] += register_at(of[0] + k, i) * w;
                b.registers[i] += register_at(of[1] + k, i) * w;
                c.registers[i] += register_at(of[2] + k, i) * w;
                d.registers[i] += register_at(of[3] + k, i) * w;
            }
        }
        Parts* const all[4] = {&a, &b, &c, &d};
        for (long i = 0; i < 4 && r + i < n_rows; ++i) {
            add_rest(of[i], v, whole, n, *all[i]);
            add_up(*all[i], sums[r + i]);
        }
    }
}

void add_gram(const double* rows, long n_rows, double* sums) {
    for (long r = 0; r < n_rows; r += 2)
        for (long s = 0; s <= r; s += 2) {
            const bool is_r_last = r + 1 == n_rows, is_s_last = s + 1 == n_rows;
            const double* a = rows + r * stretch;
            const double* b = is_r_last ? a : a + stretch;
            const double* c = rows + s * stretch;
            const double* d = is_s_last ? c : c + stretch;
            Parts ac{}, ad{}, bc{}, bd{};
            for (long k = 0; k < stretch; k += parts) {
                for (long i = 0; i < n_registers; ++i) {
                    Register va = register_at(a + k, i), vb = register_at(b + k, i),
                             vc = register_at(c + k, i), vd = register_at(d + k, i);
                    hold(va), hold(vb), hold(vc), hold(vd);
                    ac.registers[i] += va * vc;
                    ad.registers[i] += va * vd;
                    bc.registers[i] += vb * vc;
                    bd.registers[i] += vb * vd;
                }
            }
            double* const row = sums + r * n_rows;
            add_up(ac, row[s]);
            if (!is_s_last) add_up(ad, row[s + 1]);
            if (!is_r_last) add_up(bc, row[n_rows + s]);
            if (!is_r_last && !is_s_last) add_up(bd, row[n_rows + s + 1]);
        }
}

}  // namespace
