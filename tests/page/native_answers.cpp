// The functions of the page, compiled for this machine: reads settings and writes what the page's functions
// say. usage: native_answers SETTINGS ANSWERS FRAMES ROWS CURVES WORDS MODES All files but the last two hold
// doubles; WORDS has a line of JSON for each setting, MODES the letters of each mode.

#include "page/machine.hpp"

#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

extern "C" {
char const* page_error();
int page_prepare_atlas();
char const* page_names();
char const* page_mode(int number);
int page_answer(double const* settings, double* numbers);
int page_curve(double const* settings, int axis, double from, double to, int count, double* numbers);
int page_map_row(double const* settings, int axis, double from, double to, int count, int rolling,
                 double* numbers);
int page_frames(double const* settings, int rolling, int count, double* numbers);
char const* page_words(double const* settings);
}

namespace {

using Numbers = std::vector<double>;

// As in compare_native.js.
constexpr std::size_t answer_width = 40, frame_width = 8, frame_count = 9, row_count = 20, curve_count = 10,
                      every = 100;

Numbers read(char const* file) {
    std::ifstream stream(file, std::ios::binary | std::ios::ate);
    Numbers numbers(static_cast<std::size_t>(stream.tellg()) / sizeof(double));
    stream.seekg(0);
    stream.read(reinterpret_cast<char*>(numbers.data()),
                static_cast<std::streamsize>(numbers.size() * sizeof(double)));
    return numbers;
}

void append(char const* file, Numbers const& numbers) {
    std::ofstream stream(file, std::ios::binary | std::ios::app);
    stream.write(reinterpret_cast<char const*>(numbers.data()),
                 static_cast<std::streamsize>(numbers.size() * sizeof(double)));
}

/// What the function wrote, or NaN everywhere after an error.
template <class Function>
Numbers found(std::size_t size, Function const& function) {
    Numbers numbers(size, 0);
    if (function(numbers.data()) != 0) numbers.assign(size, std::numeric_limits<double>::quiet_NaN());
    return numbers;
}

}  // namespace

int main(int, char** files) {
    Numbers const settings = read(files[1]);
    page_prepare_atlas();
    std::ofstream words(files[6]), letters(files[7]);
    for (std::size_t i = 0; i * vibrotrough::page::setting_count < settings.size(); ++i) {
        double const* const one = settings.data() + i * vibrotrough::page::setting_count;
        append(files[2], found(answer_width, [&](double* to) { return page_answer(one, to); }));
        for (int const rolling : {0, 1})
            append(files[3], found(frame_width * frame_count,
                                   [&](double* to) { return page_frames(one, rolling, frame_count, to); }));
        words << page_words(one) << '\n';
        if (i % every != 0) continue;
        for (int const rolling : {0, 1})
            append(files[4], found(4 * row_count, [&](double* to) {
                       return page_map_row(one, 0, 2, 14, row_count, rolling, to);
                   }));
        append(files[5], found(answer_width * curve_count,
                               [&](double* to) { return page_curve(one, 1, 500, 1500, curve_count, to); }));
    }
    for (int i = 1; *page_mode(i) != '\0'; ++i) letters << page_mode(i) << '\n';
}
