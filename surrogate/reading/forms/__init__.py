"""Forms in which spreadsheets write a table, brought into one name a column and one line a cut."""
