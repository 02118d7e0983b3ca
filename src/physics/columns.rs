//! Records whose fields are all of one type, in whatever form they are needed: numbers, lanes, blocks of memory.
//!
//! A contact's history or a law's parameters exist as plain numbers (tests, checkpoints), as lanes (the engine's registers)
//! and as arrays of lanes (its memory). `columns!` writes such a record once, generic over the type of its fields.

/// What a field may be.
pub trait Field: Copy + std::fmt::Debug + Send + Sync + 'static {}

impl<T: Copy + std::fmt::Debug + Send + Sync + 'static> Field for T {}

/// A record with fields of one type, whatever that is. Implemented for the record of units, `Record<()>`, which stands for all.
pub trait Columns: Copy + Default + std::fmt::Debug + PartialEq + Send + Sync + 'static {
    /// The record with fields of type `T`.
    type Of<T: Field>: Field;
    /// Number of fields.
    const COUNT: usize;
    /// The record made of `field(k)`, field by field.
    fn build<T: Field>(field: impl FnMut(usize) -> T) -> Self::Of<T>;
    /// One of its fields.
    fn field<T: Field>(record: &Self::Of<T>, index: usize) -> T;
    /// The same, to write to.
    fn field_mut<T: Field>(record: &mut Self::Of<T>, index: usize) -> &mut T;

    /// The record with every field converted.
    #[inline(always)]
    fn map<T: Field, U: Field>(record: &Self::Of<T>, mut convert: impl FnMut(T) -> U) -> Self::Of<U> {
        Self::build(|index| convert(Self::field(record, index)))
    }

    /// The record that `combine` makes of two, field by field.
    #[inline(always)]
    fn zip<T: Field, U: Field>(
        one: &Self::Of<T>,
        other: &Self::Of<T>,
        mut combine: impl FnMut(T, T) -> U,
    ) -> Self::Of<U> {
        Self::build(|index| combine(Self::field(one, index), Self::field(other, index)))
    }

    /// Sets one place in the arrays of a record.
    fn set_lane<T: Field, const N: usize>(arrays: &mut Self::Of<[T; N]>, lane: usize, record: &Self::Of<T>) {
        for index in 0..Self::COUNT {
            Self::field_mut(arrays, index)[lane] = Self::field(record, index);
        }
    }

    /// The fields of a record, in their order.
    fn values<T: Field>(record: &Self::Of<T>) -> impl Iterator<Item = T> {
        (0..Self::COUNT).map(|index| Self::field(record, index))
    }
}

/// The record of `C` with fields of type `T`.
pub type Of<C, T> = <C as Columns>::Of<T>;

/// Declares a record of columns; see the module. The comments on the fields become `MEANINGS`.
macro_rules! columns {
    ($(#[$attribute:meta])* pub struct $name:ident { $($(#[doc = $meaning:literal])* $field:ident,)* }) => {
        $(#[$attribute])*
        #[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize, serde::Deserialize)]
        pub struct $name<T = ()> { $($(#[doc = $meaning])* pub $field: T,)* }

        #[allow(dead_code)]
        impl $name {
            /// The names of the fields.
            pub const NAMES: &'static [&'static str] = &[$(stringify!($field)),*];
            /// What the fields mean.
            pub const MEANINGS: &'static [&'static str] = &[$(concat!($($meaning),*)),*];
        }

        /// A set of fields: those that are true.
        #[allow(dead_code)]
        impl $name<bool> {
            /// The empty set.
            pub const NONE: Self = Self { $($field: false,)* };

            /// The fields of either set.
            #[must_use]
            pub const fn union(self, other: Self) -> Self {
                Self { $($field: self.$field || other.$field,)* }
            }
        }

        impl $crate::physics::columns::Columns for $name {
            type Of<T: $crate::physics::columns::Field> = $name<T>;
            const COUNT: usize = $name::NAMES.len();

            #[inline(always)]
            #[allow(unused_mut, unused_variables)]
            fn build<T: $crate::physics::columns::Field>(mut field: impl FnMut(usize) -> T) -> $name<T> {
                let mut index = 0..;
                $name { $($field: field(index.next().unwrap_or_default()),)* }
            }

            #[inline(always)]
            fn field<T: $crate::physics::columns::Field>(record: &$name<T>, index: usize) -> T {
                let fields: &[&T] = &[$(&record.$field),*];
                *fields[index]
            }

            #[inline(always)]
            fn field_mut<T: $crate::physics::columns::Field>(record: &mut $name<T>, index: usize) -> &mut T {
                let fields: [&mut T; $name::NAMES.len()] = [$(&mut record.$field),*];
                let mut fields = fields.into_iter();
                fields.nth(index).expect("a field of the record")
            }
        }
    };
}
pub(crate) use columns;

impl Columns for () {
    type Of<T: Field> = ();
    const COUNT: usize = 0;

    #[inline(always)]
    fn build<T: Field>(_field: impl FnMut(usize) -> T) {}

    fn field<T: Field>((): &(), _index: usize) -> T {
        unreachable!("a record without fields")
    }

    fn field_mut<T: Field>((): &mut (), _index: usize) -> &mut T {
        unreachable!("a record without fields")
    }
}

/// Two records as one, the fields of the first in front.
impl<A: Columns, B: Columns> Columns for (A, B) {
    type Of<T: Field> = (A::Of<T>, B::Of<T>);
    const COUNT: usize = A::COUNT + B::COUNT;

    #[inline(always)]
    fn build<T: Field>(mut field: impl FnMut(usize) -> T) -> Self::Of<T> {
        (A::build(&mut field), B::build(|index| field(A::COUNT + index)))
    }

    #[inline(always)]
    fn field<T: Field>(record: &Self::Of<T>, index: usize) -> T {
        if index < A::COUNT { A::field(&record.0, index) } else { B::field(&record.1, index - A::COUNT) }
    }

    #[inline(always)]
    fn field_mut<T: Field>(record: &mut Self::Of<T>, index: usize) -> &mut T {
        if index < A::COUNT {
            A::field_mut(&mut record.0, index)
        } else {
            B::field_mut(&mut record.1, index - A::COUNT)
        }
    }
}
