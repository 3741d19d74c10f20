#include "core/csv.hpp"

#include "core/text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vibrotrough::core {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
constexpr std::size_t longest_shown = 60;

bool is_space(char c) {
    return c == ' ' || c == '\t';
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// std::from_chars, which the C++ library of emscripten does not have for doubles.
std::from_chars_result number_from(char const* begin, char const* end, double& value) {
#ifdef __cpp_lib_to_chars
    return std::from_chars(begin, end, value);
#else
    std::string const text(begin, end);
    char* stop = nullptr;
    value = std::strtod(text.c_str(), &stop);
    return {begin + (stop - text.c_str()), stop == text.c_str() ? std::errc::invalid_argument : std::errc()};
#endif
}

std::string position(std::string const& file, int line) {
    return file.empty() ? fmt::format("line {}", line) : fmt::format("{}:{}", file, line);
}

/// ';' if there is one outside quotes on the first line of the text, else a tab, otherwise ','.
char find_separator(std::string_view text) {
    bool in_quotes = false, has_tab = false, has_comma = false;
    for (char const c : text) {
        if (c == '"') in_quotes = !in_quotes;
        if (in_quotes) continue;
        if (c == ';') return ';';
        has_tab = has_tab || c == '\t';
        has_comma = has_comma || c == ',';
        if (c == '\n') break;
    }
    return has_tab && !has_comma ? '\t' : ',';
}

/// Whether a line that is not a comment has a comma between two digits.
bool has_decimal_comma(std::string_view text) {
    for (std::size_t comma = text.find(','); comma != std::string_view::npos;
         comma = text.find(',', comma + 1)) {
        if (comma == 0 || comma + 1 == text.size() || !is_digit(text[comma - 1]) ||
            !is_digit(text[comma + 1]))
            continue;
        std::size_t const end_before = text.rfind('\n', comma);
        if (text[end_before == std::string_view::npos ? 0 : end_before + 1] != '#') return true;
    }
    return false;
}

/// Whether it is a number such as 1.450, maybe with a unit, whose point may divide thousands.
bool may_be_thousands(std::string_view cell) {
    std::string_view number = cell.substr(0, cell.find(' '));
    if (number.starts_with('+') || number.starts_with('-')) number.remove_prefix(1);
    std::size_t const point = number.find('.');
    if (point < 1 || point > 3 || number.front() == '0' || (number.size() - point) % 4 != 0) return false;
    for (std::size_t i = 0; i < number.size(); ++i) {
        bool const divides = i >= point && (i - point) % 4 == 0;
        if (divides ? number[i] != '.' : number[i] < '0' || number[i] > '9') return false;
    }
    return true;
}

}  // namespace

CsvError::CsvError(std::string const& file, int line, std::string const& problem, std::string_view cure)
    : InputError(cure.empty() ? fmt::format("{}: {}", position(file, line), problem)
                              : fmt::format("{}: {}; {}", position(file, line), problem, cure)),
      line_(line),
      problem_(problem) {}

CsvReader::CsvReader(std::string_view text, std::string file, CsvFormat format)
    : text_(text), file_(std::move(file)), format_(std::move(format)), columns_(format_.columns) {
    if (text_.size() > format_.most_bytes)
        fail_at(1, fmt::format("the file is larger than {} bytes", format_.most_bytes), "use a smaller file");
    if (text_.starts_with(byte_order_mark)) at_ = byte_order_mark.size();
    if (columns_.empty()) read_header();
}

void CsvReader::read_header() {
    if (!find_row()) {
        if (format_.growing) return;
        fail_at(1, "the file is empty", "begin it with a line of column names");
    }
    separator_ = find_separator(text_.substr(at_));
    has_decimal_commas_ = separator_ != ',' && has_decimal_comma(text_);
    if (!split()) return;  // the header of this growing text is not complete yet
    header_line_ = row_line_;
    columns_.assign(cells_.begin(), cells_.end());
    check_columns();
}

void CsvReader::check_columns() const {
    if (columns_.size() > format_.most_columns)
        fail(fmt::format("there are more than {} columns", format_.most_columns), "use a smaller table");
    std::set<std::string_view> seen;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        std::string const name = columns_[i].substr(0, longest_shown);
        if (columns_[i].find_first_of(std::string_view("\0\r", 2)) != std::string::npos)
            fail(fmt::format("the name of column {} contains control characters", i + 1),
                 "save the file as CSV in UTF-8 with line ends of Linux or Windows");
        if (columns_[i].empty())
            fail(fmt::format("column {} has no name", i + 1), "write a name or remove the separator");
        if (!seen.insert(columns_[i]).second)
            fail(fmt::format("column '{}' appears twice", name), "keep one of the two");
    }
}

bool CsvReader::has_columns(std::span<std::string_view const> names) const {
    return std::equal(columns_.begin(), columns_.end(), names.begin(), names.end());
}

/// Goes to the next line that is neither a comment nor blank. A row with quotes may be longer.
bool CsvReader::find_row() {
    while (at_ < text_.size()) {
        std::size_t const end = std::min(text_.find('\n', at_), text_.size());
        if (end == text_.size() && format_.growing) break;
        row_ = text_.substr(at_, end - at_);
        if (row_.ends_with('\r')) row_.remove_suffix(1);
        row_line_ = line_;
        bool const is_comment = format_.comments && row_.starts_with('#');
        if (!is_comment && !(format_.blanks && std::all_of(row_.begin(), row_.end(), is_space))) return true;
        skip_line();
    }
    at_ = text_.size();
    return false;
}

void CsvReader::skip_line() {
    at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1;
    ++line_;
}

/// Reads the cell whose opening quote is at `at_` and moves `at_` behind its closing quote. Returns false
/// when there is no closing quote.
bool CsvReader::read_quoted_cell(std::string_view& cell) {
    std::size_t const begin = ++at_;
    bool doubled = false;
    while (true) {
        std::size_t const quote = text_.find('"', at_);
        if (quote == std::string_view::npos) return false;
        at_ = quote + 1;
        if (at_ == text_.size() || text_[at_] != '"') break;
        doubled = true;
        ++at_;
    }
    cell = text_.substr(begin, at_ - 1 - begin);
    line_ += static_cast<int>(std::count(cell.begin(), cell.end(), '\n'));
    if (!doubled) return true;
    std::string& plain = unescaped_.emplace_back();
    for (std::size_t i = 0; i < cell.size(); ++i) {
        plain += cell[i];
        if (cell[i] == '"') ++i;
    }
    cell = plain;
    return true;
}

/// Reads a cell without quotes up to the next separator or line end.
void CsvReader::take_plain_cell() {
    std::size_t const end = std::min(text_.find_first_of(std::string{separator_, '\n'}, at_), text_.size());
    std::string_view cell = text_.substr(at_, end - at_);
    if ((end == text_.size() || text_[end] == '\n') && cell.ends_with('\r')) cell.remove_suffix(1);
    if (cell.find('"') != std::string_view::npos)
        fail_at(line_,
                fmt::format("there is a quote within the cell '{}'", trimmed(cell).substr(0, longest_shown)),
                "put the whole cell in quotes and double the quotes within it");
    cells_.push_back(trimmed(cell));
    at_ = end;
}

void CsvReader::skip_spaces() {
    while (at_ < text_.size() && text_[at_] != separator_ && is_space(text_[at_])) ++at_;
}

/// Splits the row that begins at `at_`. Returns false when a growing text does not have all of it yet.
bool CsvReader::split() {
    cells_.clear();
    unescaped_.clear();
    while (true) {
        std::size_t const start = at_;
        skip_spaces();
        if (at_ < text_.size() && text_[at_] == '"') {
            int const opened = line_;
            if (!read_quoted_cell(cells_.emplace_back())) {
                at_ = text_.size();
                if (format_.growing) return false;
                fail_at(opened, "an opening quote has no closing quote", "write the closing quote");
            }
            skip_spaces();
            if (text_.substr(at_).starts_with("\r\n") || text_.substr(at_) == "\r") ++at_;
            if (at_ < text_.size() && text_[at_] != separator_ && text_[at_] != '\n')
                fail_at(line_, "there is text after the closing quote of a cell",
                        "put the whole cell in quotes and double the quotes within it");
        } else {
            at_ = start;
            take_plain_cell();
        }
        if (at_ == text_.size()) return !format_.growing;
        if (text_[at_++] == '\n') break;
    }
    ++line_;
    return true;
}

bool CsvReader::next() {
    if (columns_.empty() || !find_row() || !split()) return false;
    count_row();
    if (cells_.size() != columns_.size()) {
        bool const are_split =
            separator_ == ',' && cells_.size() > columns_.size() && row_.find('.') == std::string_view::npos;
        fail(fmt::format("expected {} values, one per column, but found {}{}", columns_.size(), cells_.size(),
                         are_split ? ": its numbers seem to have decimal commas, but commas separate its "
                                     "columns, too; separate the columns with semicolons"
                                   : ""),
             "write one value per column");
    }
    if (has_decimal_commas_) refuse_thousands();
    return true;
}

void CsvReader::refuse_thousands() const {
    for (std::string_view const cell : cells_)
        if (may_be_thousands(cell))
            fail(fmt::format(
                     "'{}' can be read with and without thousands, as other numbers of this file have a "
                     "decimal comma",
                     cell),
                 "write 1450 or 1,450");
}

void CsvReader::count_row() {
    if (++rows_ > format_.most_rows)
        fail(fmt::format("there are more than {} rows", format_.most_rows), "use a smaller table");
}

/// Reads the numbers without splitting the row into cells. Returns false when it contains anything but
/// numbers and commas.
bool CsvReader::parse_numbers(std::span<double> row) const {
    char const* at = row_.data();
    char const* const end = at + row_.size();
    for (std::size_t column = 0; column < row.size(); ++column) {
        auto const [stop, failure] = number_from(at, end, row[column]);
        if (failure != std::errc()) return false;
        if (format_.numbers == CsvNumbers::finite && !std::isfinite(row[column])) return false;
        bool const last = column + 1 == row.size();
        if (last ? stop != end : (stop == end || *stop != ',')) return false;
        at = stop + 1;
    }
    return true;
}

bool CsvReader::next(std::span<double> row) {
    if (columns_.empty()) return false;
    if (row.size() != columns_.size())
        throw std::invalid_argument("CsvReader::next: the row must have one element for each column");
    if (!find_row()) return false;
    if (separator_ == ',' && parse_numbers(row)) {
        skip_line();
        count_row();
        return true;
    }
    if (!next()) return false;
    for (std::size_t column = 0; column < row.size(); ++column) row[column] = number(column);
    return true;
}

double CsvReader::number(std::size_t column) const {
    if (auto const value = csv_number(cells_[column], separator_, format_.numbers)) return *value;
    fail(fmt::format("column {}: '{}' is not a {}number", columns_[column],
                     cells_[column].substr(0, longest_shown),
                     format_.numbers == CsvNumbers::finite ? "finite " : ""),
         "write a number such as 0.5");
}

std::optional<double> CsvReader::number_if_given(std::size_t column) const {
    if (cells_[column].empty()) return {};
    return number(column);
}

void CsvReader::fail(std::string const& problem, std::string_view cure) const {
    fail_at(row_line_, problem, cure);
}

void CsvReader::fail_at(int line, std::string const& problem, std::string_view cure) const {
    throw CsvError(file_, line, problem, format_.cure.empty() ? cure : format_.cure);
}

std::optional<double> csv_number(std::string_view cell, char separator, CsvNumbers numbers) {
    std::string text;
    if (separator != ',' && cell.find(',') != std::string_view::npos) {
        text = with_decimal_point(cell, separator);
        cell = text;
    }
    if (cell.size() > 1 && cell[0] == '+' && cell[1] != '-') cell.remove_prefix(1);
    double value = 0;
    char const* const end = cell.data() + cell.size();
    auto const [stop, failure] = number_from(cell.data(), end, value);
    if (failure != std::errc() || stop != end) return {};
    if (numbers == CsvNumbers::finite && !std::isfinite(value)) return {};
    return value;
}

std::string with_decimal_point(std::string_view cell, char separator) {
    std::string text(cell);
    std::size_t const comma = text.find(',');
    bool const decimal = separator != ',' && comma != std::string::npos && comma + 1 < text.size() &&
                         is_digit(text[comma + 1]) &&
                         text.find_first_of(".,", comma + 1) == std::string::npos &&
                         text.find('.') == std::string::npos;
    if (decimal) text[comma] = '.';
    return text;
}

std::string csv_cell(std::string_view text) {
    bool const plain = text.find_first_of(",;\"\r\n") == std::string_view::npos && trimmed(text) == text &&
                       !text.starts_with('#');
    if (plain) return std::string(text);
    std::string cell = "\"";
    for (char const c : text) {
        if (c == '"') cell += '"';
        cell += c;
    }
    return cell + '"';
}

std::vector<NumberRow> read_number_table(std::string_view text,
                                         std::initializer_list<std::string_view> columns) {
    std::vector<NumberRow> rows;
    try {
        // A blank text has no rows, like a text that holds only the header.
        CsvFormat const format{.comments = true, .blanks = true};
        if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) return rows;
        CsvReader table(text, "", format);
        if (!table.has_columns(columns))
            throw std::invalid_argument(fmt::format("line {}: this is not the header {}", table.header_line(),
                                                    fmt::join(columns, ",")));
        std::vector<double> values(columns.size());
        while (table.next(values)) rows.push_back({values, table.line()});
    } catch (CsvError const& error) {
        throw std::invalid_argument(fmt::format("line {}: {}", error.line(), error.problem()));
    }
    return rows;
}

}  // namespace vibrotrough::core
