#pragma once

#include "core/error.hpp"

#include <cstddef>
#include <deque>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vibrotrough::core {

/// A CSV text cannot be read. The message is "file:line: problem; what to do", or "line N: problem; what to
/// do" when the text has no file name.
class CsvError : public InputError {
  public:
    /// @param file     name of the text; may be empty
    /// @param line     from 1
    /// @param problem  what is wrong
    /// @param cure     what to do about it; may be empty
    CsvError(std::string const& file, int line, std::string const& problem, std::string_view cure);
    int line() const { return line_; }  ///< line of the text, from 1
    /// What is wrong, without file and line and without advice.
    std::string const& problem() const { return problem_; }

  private:
    int line_;
    std::string problem_;
};

/// Which numbers a file may hold.
enum class CsvNumbers {
    finite,  ///< infinities and NaN are refused
    any,     ///< "inf" and "nan" are accepted as well, because a simulation that diverges writes them
};

/// How a text is to be read. By default it is one header line and then one row per line.
struct CsvFormat {
    bool comments = false;  ///< skip lines that begin with #
    bool blanks = false;    ///< skip lines that hold only spaces
    bool growing = false;   ///< leave out a last line without line end, which is still being written
    CsvNumbers numbers = CsvNumbers::finite;  ///< which numbers are accepted
    std::vector<std::string> columns = {};    ///< names of the columns of a text without header, with commas
    std::string_view cure = {};               ///< advice for every error; if empty, each error has its own
    std::size_t most_bytes = std::numeric_limits<std::size_t>::max();  ///< largest size that is accepted
    std::size_t most_rows =
        std::numeric_limits<std::size_t>::max();  ///< largest number of rows, without header
    std::size_t most_columns = 1000;              ///< largest number of columns
};

/// Reads a CSV text (RFC 4180) row by row.
///
/// - The separator is ';' where the header line has one outside quotes, a tab where it has a tab and no
/// comma,
///   and ',' otherwise. Where it is not the comma, numbers may have a decimal comma. Beside such numbers
///   1.450 is refused, because it may be 1450.
/// - A cell in double quotes may hold separators, line ends and doubled quotes. Spaces and tabs around a
///   cell do not belong to it unless they are within its quotes.
/// - Lines end with LF or CR LF. A UTF-8 byte order mark is skipped.
/// - Every row has as many cells as the header. Column names are neither empty nor given twice.
///
/// The text must outlive the reader and the cells.
class CsvReader {
  public:
    /// Reads the header. @param file  names the text in errors; may be empty
    /// @throws CsvError when the text is empty, too large, or its header is malformed
    CsvReader(std::string_view text, std::string file, CsvFormat format = {});

    /// Names of the columns; empty when a growing text has no whole header line yet.
    std::vector<std::string> const& columns() const { return columns_; }
    /// Whether the columns are exactly these, in this order.
    bool has_columns(std::span<std::string_view const> names) const;
    char separator() const { return separator_; }     ///< ',', ';' or a tab
    int header_line() const { return header_line_; }  ///< from 1; 0 when there is no header line

    /// Goes to the next row. Returns false after the last one.
    /// @throws CsvError when the row is malformed or the table has too many rows
    bool next();
    /// Goes to the next row and reads all its cells as numbers. This is the fast way for large tables.
    /// Returns false after the last row.
    /// @param row  receives the numbers, one for each column
    /// @throws CsvError when the row is malformed or has a cell that is not a number
    /// @throws std::invalid_argument when `row` has another length than columns()
    bool next(std::span<double> row);

    /// The row's line in the text, from 1; its first line when quotes make it longer.
    int line() const { return row_line_; }
    /// The cells of the row after `next()`, without their quotes.
    std::span<std::string_view const> cells() const { return cells_; }
    /// The number in a cell of the row. @throws CsvError that names the column when the cell is not a number
    double number(std::size_t column) const;
    /// The number in a cell of the row, or nullopt when the cell is empty. @throws CsvError as number()
    std::optional<double> number_if_given(std::size_t column) const;

    /// Reports a problem of the current row. @throws CsvError with its line and the advice `cure`, unless the
    /// format has advice for every error
    [[noreturn]] void fail(std::string const& problem, std::string_view cure) const;

  private:
    bool find_row();
    void skip_line();
    bool split();
    void count_row();
    bool read_quoted_cell(std::string_view& cell);
    void take_plain_cell();
    void skip_spaces();
    void read_header();
    void check_columns() const;
    void refuse_thousands() const;
    bool parse_numbers(std::span<double> row) const;
    [[noreturn]] void fail_at(int line, std::string const& problem, std::string_view cure) const;

    std::string_view text_;
    std::string file_;
    CsvFormat format_;
    std::vector<std::string> columns_;
    char separator_ = ',';
    bool has_decimal_commas_ = false;
    int header_line_ = 0;
    std::size_t at_ = 0;  ///< index in `text_` at which the row or the next one begins
    int line_ = 1;        ///< the line at `at_`
    int row_line_ = 0;
    std::size_t rows_ = 0;
    std::string_view row_;  ///< the first line of the row, without its end
    std::vector<std::string_view> cells_;
    std::deque<std::string> unescaped_;  ///< cells of this row that had doubled quotes
};

/// The number that a cell holds, or nullopt when it does not hold exactly one number. A leading '+' is
/// allowed.
/// @param separator  of the cells; unless it is ',', the number may have a decimal comma
std::optional<double> csv_number(std::string_view cell, char separator, CsvNumbers numbers);

/// The cell with a decimal point instead of a decimal comma: "9,5 mm" becomes "9.5 mm" unless ',' separates
/// the cells. Other text stays as it is.
std::string with_decimal_point(std::string_view cell, char separator);

/// The text as a cell of a CSV file whose cells are separated by commas; in quotes where they are needed.
std::string csv_cell(std::string_view text);

/// A row of a table of numbers.
struct NumberRow {
    std::vector<double> values;  ///< one for each column
    int line;                    ///< line of the text, from 1
};

/// Reads a small table of finite numbers with exactly these columns. Comment lines that begin with # and
/// blank lines are skipped. A text without a header has no rows.
/// @throws std::invalid_argument whose message has the line but not the file, which the caller adds
std::vector<NumberRow> read_number_table(std::string_view text,
                                         std::initializer_list<std::string_view> columns);

}  // namespace vibrotrough::core
