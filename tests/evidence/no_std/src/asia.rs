use cotama_inference::{Operand, Query, Step};

/// Probabilities of lung given dysp, xray, in this order.
pub const QUERY: Query<'_> = Query {
    tables: &[
        10737418, 1063004406, 53687091, 1020054733, 10737418, 1063004406, 1073741824, 0,
        1073741824, 0, 1073741824, 0, 0, 1073741824, 536870912, 536870912, 107374182, 966367642,
        10737418, 1063004406, 644245094, 429496730, 322122547, 751619277, 966367642, 107374182,
        858993459, 214748365, 751619277, 322122547, 107374182, 966367642, 1052266988, 21474836,
        53687091, 1020054733,
    ],
    steps: &[
        Step {
            operands: &[
                Operand { is_result: false, at: 0, strides: &[0], inner: 1, fixed: &[] },
                Operand { is_result: false, at: 2, strides: &[1], inner: 2, fixed: &[] },
            ],
            shape: &[2],
            summed: 2,
            to: 0,
        },
        Step {
            operands: &[
                Operand { is_result: false, at: 6, strides: &[4, 1], inner: 2, fixed: &[] },
                Operand { is_result: true, at: 0, strides: &[0, 0], inner: 1, fixed: &[] },
            ],
            shape: &[2, 2],
            summed: 2,
            to: 2,
        },
        Step {
            operands: &[
                Operand { is_result: false, at: 14, strides: &[0, 0], inner: 1, fixed: &[] },
                Operand { is_result: false, at: 16, strides: &[1, 0], inner: 2, fixed: &[] },
                Operand { is_result: false, at: 20, strides: &[0, 1], inner: 2, fixed: &[] },
            ],
            shape: &[2, 2],
            summed: 2,
            to: 6,
        },
        Step {
            operands: &[
                Operand { is_result: false, at: 24, strides: &[0, 2], inner: 4, fixed: &[(0, 1)] },
                Operand { is_result: true, at: 6, strides: &[2, 0], inner: 1, fixed: &[] },
            ],
            shape: &[2, 2],
            summed: 2,
            to: 10,
        },
        Step {
            operands: &[
                Operand { is_result: false, at: 32, strides: &[0], inner: 2, fixed: &[(1, 1)] },
                Operand { is_result: true, at: 2, strides: &[2], inner: 1, fixed: &[] },
                Operand { is_result: true, at: 10, strides: &[2], inner: 1, fixed: &[] },
            ],
            shape: &[2],
            summed: 2,
            to: 14,
        },
        Step {
            operands: &[Operand { is_result: true, at: 14, strides: &[1], inner: 0, fixed: &[] }],
            shape: &[2],
            summed: 1,
            to: 16,
        },
    ],
    evidence: &[2, 2],
    scratch: 18,
    rounded: 4638566680,
};
