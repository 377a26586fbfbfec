"""A sparse matrix that grows by rows."""
import numpy as np
from scipy.sparse import coo_matrix


class Rows:
    def __init__(self):
        self.row, self.column, self.value, self.right = [], [], [], []

    def add(self, columns, values, right=0.0):
        """One equation or inequality."""
        self.row.extend([len(self.right)] * len(columns))
        self.column.extend(columns)
        self.value.extend(values)
        self.right.append(right)

    def matrix(self, columns):
        shape = (len(self.right), columns)
        return coo_matrix((self.value, (self.row, self.column)), shape=shape).tocsr(), np.array(self.right)
