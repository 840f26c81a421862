// bench_plot.c - the cases as a bar chart: one SVG, suites above each other.
//
// A bar is a median on a logarithmic scale, because the cases of a suite differ by orders of
// magnitude; a line across it reaches from the least to the greatest time.
#include <math.h>
#include <string.h>

#include "cli/bench.h"

enum { WIDTH = 960, LABEL = 300, VALUE = 90, ROW = 18, HEADING = 34, MARGIN = 12 };

// Text with what XML reserves written out.
static void print_text(FILE *file, const char *text) {
    for (const char *c = text; *c; c++) {
        const char *written = *c == '<' ? "&lt;" : *c == '>' ? "&gt;" : *c == '&' ? "&amp;" : NULL;
        if (written)
            fputs(written, file);
        else
            fputc(*c, file);
    }
}

static int count_suite(const struct bench *bench, int first) {
    int count = 0;
    while (first + count < bench->case_count &&
           strcmp(bench->cases[first + count].suite, bench->cases[first].suite) == 0)
        count++;
    return count;
}

// The powers of ten that hold all times of a suite.
static void find_scale(const struct bench *bench, int first, int count, double scale[2]) {
    double least = INFINITY, greatest = -INFINITY;
    for (int i = first; i < first + count; i++) {
        least = fmin(least, bench_least(&bench->cases[i].frame));
        greatest = fmax(greatest, bench_greatest(&bench->cases[i].frame));
    }
    scale[0] = isfinite(least) && least > 0 ? floor(log10(least)) : 0;
    scale[1] = isfinite(greatest) && greatest > 0 ? ceil(log10(greatest)) : 1;
    if (scale[1] <= scale[0])
        scale[1] = scale[0] + 1;
}

static double place(double ms, const double scale[2]) {
    double share = (log10(ms) - scale[0]) / (scale[1] - scale[0]);
    return LABEL + share * (WIDTH - LABEL - VALUE);
}

static void print_case(FILE *file, const struct bench_case *one, int y, const double scale[2]) {
    fprintf(file, "<text x=\"%d\" y=\"%d\" text-anchor=\"end\">", LABEL - 8, y + ROW - 5);
    if (one->transfer[0] && !strstr(one->name, one->transfer))
        fprintf(file, "%s ", one->transfer);
    print_text(file, one->name);
    if (one->volumes > 1)
        fprintf(file, ", %d volumes", one->volumes);
    fputs("</text>\n", file);
    double ms = bench_median(&one->frame);
    if (!isfinite(ms) || ms <= 0)
        return;
    double end = place(ms, scale), low = place(bench_least(&one->frame), scale),
           high = place(bench_greatest(&one->frame), scale);
    fprintf(file, "<rect x=\"%d\" y=\"%d\" width=\"%.1f\" height=\"%d\" fill=\"#31688e\"/>\n",
            LABEL, y + 3, end - LABEL, ROW - 6);
    fprintf(file, "<path d=\"M%.1f %dH%.1f\" stroke=\"#222\"/>\n", low, y + ROW / 2, high);
    fprintf(file, "<text x=\"%.1f\" y=\"%d\">%.*f ms</text>\n", fmax(end, high) + 6, y + ROW - 5,
            ms >= 100  ? 0
            : ms >= 10 ? 1
                       : 2,
            ms);
}

void bench_write_plot(FILE *file, const struct bench *bench, const struct bench_machine *machine) {
    int suites = 0;
    for (int first = 0; first < bench->case_count; first += count_suite(bench, first))
        suites++;
    int height = 2 * MARGIN + ROW + suites * (HEADING + ROW) + bench->case_count * ROW;
    fprintf(file,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" "
            "font-family=\"sans-serif\" font-size=\"12\">\n"
            "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n<text x=\"%d\" "
            "y=\"%d\">Pellucid ",
            WIDTH, height, MARGIN, MARGIN + ROW - 5);
    fputs(pel_version(), file);
    fputs(" on ", file);
    print_text(file, machine->device[0] ? machine->device : "an unknown device");
    fputs(": medians, and from least to greatest</text>\n", file);
    int y = MARGIN + ROW;
    for (int first = 0, count; first < bench->case_count; first += count) {
        count = count_suite(bench, first);
        double scale[2];
        find_scale(bench, first, count, scale);
        fprintf(file, "<text x=\"%d\" y=\"%d\" font-weight=\"bold\">%s</text>\n", MARGIN,
                y + HEADING - 10, bench->cases[first].suite);
        y += HEADING;
        for (double power = scale[0]; power <= scale[1]; power++) {
            double x = place(pow(10, power), scale);
            fprintf(file, "<path d=\"M%.1f %dV%d\" stroke=\"#ccc\"/>\n", x, y, y + count * ROW);
            fprintf(file,
                    "<text x=\"%.1f\" y=\"%d\" text-anchor=\"middle\" fill=\"#666\">%g ms</text>\n",
                    x, y + count * ROW + ROW - 5, pow(10, power));
        }
        for (int i = 0; i < count; i++, y += ROW)
            print_case(file, &bench->cases[first + i], y, scale);
        y += ROW;
    }
    fputs("</svg>\n", file);
}
